// Tests of the formats that a run can be looked at in: each says where the grains are at every frame, as the frames do.
#include <doctest/doctest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "common/read_file.hpp"
#include "model/scene.hpp"
#include "observe/wall_mesh.hpp"
#include "output/picture.hpp"
#include "read_array.hpp"
#include "scenes.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

constexpr std::size_t kBodies = 5, kFrames = 4;
const std::string kSummary = "[run]\nscene = \"pictures\"\n";

Scene scene_of_two_kinds() {
  Scene scene{};
  scene.name = "pictures";
  scene.container = Box{{0.1, 0.1}};
  scene.kinds = {{{"bean", {0.006, 0.004, 0.003}, 2.5, 2.2, 0, 1200, "typical"}, 3},
                 {{"die </script>", {0.008, 0.008, 0.008}, 20, 20, 0.001, 1200, "typical"}, 2}};
  return scene;
}

/// Grains that turn and move, but for the last, which stands still; two of them touch from the second frame on.
Frame frame_at(std::size_t index) {
  Frame frame;
  const auto t = static_cast<double>(index);
  frame.time = 0.1 * t;
  frame.energy = {0.5 * t, 1 - t};
  frame.wall_places = {{}, {}, {{0.1 * t, 0.2, 0.3}, {std::cos(0.3 * t), 0, std::sin(0.3 * t), 0}, 1}};
  for (std::size_t k = 0; k < kBodies; ++k) {
    const double moved = k + 1 == kBodies ? 0 : t;
    const auto body = static_cast<double>(k);
    const double half = 0.4 * moved + body;
    frame.grains.push_back({{0.01 * body + 1.0 / 3, 0.02 * moved, 0.05 - 0.01 * moved},
                            {std::cos(half), 0, std::sin(half) * 0.6, std::sin(half) * 0.8},
                            {0, 0.2, -0.1},
                            {0, 0, 8 * body}});
  }
  if (index > 0) frame.contacts = {{{0.1, 0.2, 0.3}, {0, 0, 1}, 1e-5, 0, 1}, {{0.1, 0.2, 0}, {0, 1, 0}, 2e-5, 3, kWall}};
  return frame;
}

/// Floor, walls, and a plate that moves and turns.
std::vector<WallPicture> walls_of_scene(const Scene& scene) {
  std::vector<WallPicture> walls = pictures_of(scene.container, 0.1);
  Wall plate{"plate", BoxShape{{0.02, 0.04, 0.01}}};
  plate.motions = {{Translation{{1, 0, 0}}}};
  walls.push_back(picture_of(plate, {Vector3::Constant(-0.5), Vector3::Constant(0.5)}));
  return walls;
}

/// A corner of the plate at a frame.
Vector3 corner_at(std::size_t index) {
  const Frame frame = frame_at(index);
  const auto& [p, q, scale] = frame.wall_places[2];
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vector3(0.01, 0.02, 0.005) + Vector3(p[0], p[1], p[2]);
}

/// Writes the frames in one format and gives the folder to look at.
class Written {
 public:
  explicit Written(std::string_view format, const std::vector<double>& scales = {}, const Container& container = Box{{0.1, 0.1}},
                   const std::vector<BondPicture>& bonds = {})
      : scene_(scene_of_two_kinds()), out_(folder_.path(), "pictures", result_names()) {
    scene_.container = container;
    const PictureFormat& found = *find_picture_format(format);
    const Contents contents{&scene_, {0, 1, 0, 1, 0}, walls_of_scene(scene_), scales, bonds};
    const std::unique_ptr<Picture> picture = found.make(out_, found, contents);
    for (std::size_t index = 0; index < kFrames; ++index) {
      Frame frame = frame_at(index);
      frame.wall_places.insert(frame.wall_places.begin(), contents.walls.size() - frame.wall_places.size(), WallPlace{});
      picture->add(frame);
    }
    picture->finish(kSummary);
    for (const std::string_view file : found.files) {
      CHECK(std::filesystem::exists(out_.file(std::string(file))) == (file != "bonds.pvd" || !bonds.empty()));
    }
  }
  std::string path(const std::string& name) const { return out_.file(name).string(); }
  std::string text(const std::string& name) const { return read_file(path(name)); }
  const Scene& scene() const { return scene_; }

 private:
  TemporaryFolder folder_;
  Scene scene_;
  OutputFolder out_;
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("glb: a mesh a kind, and the tracks of the bodies that move") {
  const Written written("glb");
  const tinygltf::Model model = read_glb(written.path("scene.glb"));
  REQUIRE(model.meshes.size() == 5);  // two of the grains, floor, walls and plate
  CHECK(model.meshes[2].name == "floor");
  CHECK(model.meshes[1].name == "die </script>");
  REQUIRE(model.nodes.size() == kBodies + 4);
  CHECK(model.nodes[kBodies + 1].mesh == 3);
  CHECK(model.nodes[3].mesh == 1);
  REQUIRE(model.animations.size() == 1);
  const tinygltf::Animation& animation = model.animations[0];
  CHECK(animation.channels.size() == 2 * (kBodies - 1) + 2);  // and the plate
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    CHECK(read(model, sampler.input).size() == kFrames);
    const std::vector<float> track = read(model, sampler.output);
    const std::size_t width = channel.target_path == "translation" ? 3 : 4;
    REQUIRE(track.size() == width * kFrames);
    for (std::size_t index = 0; index < kFrames; ++index) {
      const Frame frame = frame_at(index);
      const auto node = static_cast<std::size_t>(channel.target_node);
      const Point& position = node < kBodies ? frame.grains[node].position : frame.wall_places[node - kBodies].position;
      const auto& [w, x, y, z] = node < kBodies ? frame.grains[node].quaternion : frame.wall_places[node - kBodies].quaternion;
      const std::array<double, 4> turned = {x, y, z, w};
      double along = 0;
      for (std::size_t i = 0; i < width; ++i) {
        if (width == 3) CHECK(track[3 * index + i] == static_cast<float>(position[i]));
        if (width == 4) along += track[4 * index + i] * turned[i];
      }
      if (width == 4) CHECK(std::abs(along) == doctest::Approx(1).epsilon(1e-6));
    }
  }
  // The one that stands still is placed, not animated.
  CHECK(model.nodes[kBodies - 1].translation[0] == doctest::Approx(frame_at(0).grains[kBodies - 1].position[0]).epsilon(1e-7));
}

TEST_CASE("glb: a wall with a field has a colour and a number for each triangle, and edges as other walls") {
  const TemporaryFolder folder;
  const Scene scene = scene_of_two_kinds();
  const Contents contents{&scene, {0, 1, 0, 1, 0}, walls_of_scene(scene)};
  const OutputFolder out(folder.path(), "pictures", result_names());
  const PictureFormat& format = *find_picture_format("glb");
  const std::unique_ptr<Picture> picture = format.make(out, format, contents);
  Frame frame = frame_at(0);
  frame.fields = {{"wear_depth", {{}, {}, std::vector<double>(12)}}, {"wear_volume", {{}, {}, std::vector<double>(12, 1)}}};
  for (std::size_t k = 0; k < 12; ++k) frame.fields[0].of_walls[2][k] = 1e-9 * static_cast<double>(k);
  picture->add(frame);
  picture->finish(kSummary);
  const tinygltf::Model model = read_glb(out.file("scene.glb"));
  const auto colour_of = [&](const tinygltf::Primitive& primitive) {
    return model.materials[static_cast<std::size_t>(primitive.material)].pbrMetallicRoughness.baseColorFactor;
  };
  const std::vector<tinygltf::Primitive>& floor = model.meshes[2].primitives;
  const std::vector<tinygltf::Primitive>& plate = model.meshes[4].primitives;
  REQUIRE(floor.size() == 2);
  REQUIRE(plate.size() == 2);
  CHECK(plate[0].mode == TINYGLTF_MODE_LINE);
  CHECK(colour_of(plate[0]) == colour_of(floor[0]));
  CHECK(colour_of(plate[1]) == std::vector<double>{1, 1, 1, 1});
  const std::vector<float> numbers = read(model, plate[1].attributes.at("_wear_depth"));
  const std::vector<float> colours = read(model, plate[1].attributes.at("COLOR_0"));
  const std::vector<float> corners = read(model, plate[1].attributes.at("POSITION"));
  REQUIRE(numbers.size() == 36);
  REQUIRE(colours.size() == 4 * 36);
  const Mesh& mesh = contents.walls[2].mesh;
  for (std::size_t k = 0; k < 36; ++k) {
    const std::size_t triangle = k / 3;
    CHECK(numbers[k] == static_cast<float>(1e-9 * static_cast<double>(triangle)));
    for (std::size_t i = 0; i < 3; ++i) CHECK(corners[3 * k + i] == mesh.vertices[mesh.triangles[triangle][k % 3]][i]);
    const double opaque = 0.16 + 0.84 * static_cast<double>(triangle) / 11;
    CHECK(colours[4 * k + 3] == doctest::Approx(opaque).epsilon(1e-6));
  }
  for (std::size_t i = 0; i < 4; ++i) CHECK(colours[i] == static_cast<float>(colour_of(floor[0])[i]));
}

TEST_CASE("page: what it needs is in it, and names cannot end a script") {
  const Written written("page");
  const std::string text = written.text("view.html");
  CHECK(count_of(text, "<!-- the run -->") == 0);
  CHECK(count_of(text, "src=") == 0);  // nothing beside it
  const std::string start = R"(<script type="application/json" id="run">)";
  const std::size_t at = text.find(start) + start.size();
  const std::string description = text.substr(at, text.find('\n', at) - at - std::string("</script>").size());
  CHECK(description.find('<') == std::string::npos);
  const nlohmann::json run = nlohmann::json::parse(description);
  CHECK(run["times"].size() == kFrames);
  CHECK(run["kinetic"][2] == frame_at(2).energy.kinetic);
  REQUIRE(run["kinds"].size() == 2);
  CHECK(run["kinds"][1]["name"] == "die </script>");
  CHECK(run["kinds"][1]["exponents"] == std::vector{20.0, 20.0});
  CHECK(run["parts"].size() == 3);
  CHECK(run["partScales"][1] == std::vector{1.0, 1.0, 1.0});
  CHECK(run["parts"][1]["moves"] == false);
  CHECK(run["parts"][2]["moves"] == true);
  // Of the part that moves alone, the quaternion with w last.
  CHECK(run["partPoses"][2] == std::vector{0.2, 0.2, 0.3, 0.0, std::sin(0.6), 0.0, std::cos(0.6)});
  CHECK(run["contacts"].size() == kFrames);
  CHECK(run["contacts"][0]["count"] == 0);
  CHECK(run["contacts"][3]["count"] == 2);
  CHECK(run["summary"] == kSummary);
  const std::size_t bodies = text.find("id=\"bodies\">\n");
  const std::string lines = text.substr(bodies, text.find("</script>", bodies) - bodies);
  CHECK(count_of(lines, "\n") == kFrames + 1);
}

TEST_CASE("bonds are lines between the centres of grains, until they break") {
  const std::vector<BondPicture> bonds = {{0, 1}, {2, 3, 0.15}};
  const Written series("vtk", {}, Box{{0.1, 0.1}}, bonds), animation("glb", {}, Box{{0.1, 0.1}}, bonds);
  CHECK(count_of(series.text("bonds.pvd"), "<DataSet ") == kFrames);
  CHECK(series.text("vtk/bonds_000001.vtp").find("NumberOfLines=\"2\"") != std::string::npos);
  CHECK(series.text("vtk/bonds_000002.vtp").find("NumberOfLines=\"1\"") != std::string::npos);
  CHECK(Written("page", {}, Box{{0.1, 0.1}}, bonds).text("view.html").find(R"("bodies":"AAAAAAEAAAACAAAAAwAAAA==")") !=
        std::string::npos);
  const tinygltf::Model model = read_glb(animation.path("scene.glb"));
  REQUIRE(model.nodes.size() == kBodies + 3 + bonds.size() + 1);
  REQUIRE(model.meshes.size() == 6);
  CHECK(model.nodes[kBodies + 3].name == "bond 0");
  CHECK(read(model, model.meshes[5].primitives[0].attributes.at("POSITION")) == std::vector<float>{0, 0, 0, 0, 0, 1});
  const auto sampler = [&](std::size_t node, const std::string& path) {
    const auto& channels = model.animations[0].channels;
    const auto found = std::ranges::find_if(channels, [&](const tinygltf::AnimationChannel& channel) {
      return channel.target_node == static_cast<int>(node) && channel.target_path == path;
    });
    REQUIRE(found != channels.end());
    return read(model, model.animations[0].samplers[static_cast<std::size_t>(found->sampler)].output);
  };
  const std::size_t last = kBodies + 4;
  const std::vector<float> from = sampler(last, "translation"), scales = sampler(last, "scale");
  for (std::size_t index = 0; index < kFrames; ++index) {
    const Frame frame = frame_at(index);
    const bool is_broken = frame.time > 0.15;
    const Point &a = frame.grains[2].position, &b = frame.grains[3].position;
    const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    CHECK(scales[3 * index + 2] == (is_broken ? 0 : static_cast<float>(length)));
    if (!is_broken) CHECK(from[3 * index] == static_cast<float>(a[0]));
  }
}

TEST_CASE("lammps: diameters, quaternions with w last, roundness") {
  const Written written("lammps");
  std::istringstream stream(written.text("grains.lammpstrj"));
  std::string line;
  for (std::size_t index = 0; index < kFrames; ++index) {
    const Frame frame = frame_at(index);
    while (std::getline(stream, line) && !line.starts_with("ITEM: ATOMS")) {
    }
    for (std::size_t k = 0; k < kBodies; ++k) {
      REQUIRE(std::getline(stream, line));
      std::istringstream words(line);
      const std::vector<double> numbers{std::istream_iterator<double>(words), {}};
      REQUIRE(numbers.size() == 20);
      CHECK(numbers[0] == static_cast<double>(k + 1));
      CHECK(numbers[1] == (k % 2 == 1 ? 2 : 1));
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(numbers[2 + i] == frame.grains[k].position[i]);
        CHECK(numbers[11 + i] == frame.grains[k].quaternion[1 + i]);
        CHECK(numbers[15 + i] == 2 * written.scene().kinds[k % 2].kind.half_axes[i]);
      }
      CHECK(numbers[14] == frame.grains[k].quaternion[0]);
      CHECK(numbers[18] == 2 / written.scene().kinds[k % 2].kind.delta);
    }
  }
}

TEST_CASE("vtk: grains and contacts of every frame, also where there are none") {
  const Written written("vtk");
  CHECK(count_of(written.text("grains.pvd"), "<DataSet ") == kFrames);
  CHECK(count_of(written.text("contacts.pvd"), "<DataSet ") == kFrames);
  for (std::size_t index = 0; index < kFrames; ++index) {
    const std::vector<double> points = read_array(written.text("vtk/container_00000" + std::to_string(index) + ".vtp"), "position");
    double nearest = 1;
    for (std::size_t k = 0; k < points.size(); k += 3) {
      nearest = std::min(nearest, (Vector3(points[k], points[k + 1], points[k + 2]) - corner_at(index)).norm());
    }
    CHECK(nearest < 1e-8);
  }
  for (std::size_t index = 0; index < kFrames; ++index) {
    const Frame frame = frame_at(index);
    const std::string grains = written.text("vtk/grains_00000" + std::to_string(index) + ".vtp");
    const std::vector<double> positions = read_array(grains, "position"), quaternions = read_array(grains, "quaternion");
    REQUIRE(positions.size() == 3 * kBodies);
    REQUIRE(quaternions.size() == 4 * kBodies);
    for (std::size_t k = 0; k < kBodies; ++k) {
      for (std::size_t i = 0; i < 3; ++i) CHECK(positions[3 * k + i] == frame.grains[k].position[i]);
      for (std::size_t i = 0; i < 4; ++i) CHECK(quaternions[4 * k + i] == frame.grains[k].quaternion[i]);
    }
    const std::string contacts = written.text("vtk/contacts_00000" + std::to_string(index) + ".vtp");
    CHECK(read_array(contacts, "depth").size() == frame.contacts.size());
    CHECK(read_array(contacts, "bodies").size() == 2 * frame.contacts.size());
    CHECK(contacts.find("Name=\"position\" NumberOfComponents=\"3\"") != std::string::npos);
  }
}

TEST_CASE("povray: a grain with rounded edges is a mesh, another is exact") {
  const Written written("povray");
  const std::string text = written.text("still.pov");
  CHECK(count_of(text, "superellipsoid {") == 1);
  CHECK(count_of(text, "mesh2 {") == 1);
  // The plate is where it is in the last frame.
  const std::size_t plate = text.find("// plate");
  REQUIRE(plate != std::string::npos);
  double nearest = 1;
  for (std::size_t at = text.find("triangle {", plate); at != std::string::npos; at = text.find("triangle {", at + 1)) {
    std::array<double, 9> corners{};
    auto& [ax, ay, az, bx, by, bz, cx, cy, cz] = corners;
    REQUIRE(std::sscanf(text.c_str() + at, "triangle { <%lf, %lf, %lf>, <%lf, %lf, %lf>, <%lf, %lf, %lf> }", &ax, &ay, &az, &bx,
                        &by, &bz, &cx, &cy, &cz) == 9);
    for (std::size_t k = 0; k < 9; k += 3)
      nearest = std::min(nearest, (Vector3::Map(&corners.at(k)) - corner_at(kFrames - 1)).norm());
  }
  CHECK(nearest < 1e-8);
  CHECK(count_of(text, "object { Kind0 matrix") == 3);
  CHECK(count_of(text, "object { Kind1 matrix") == 2);
}

TEST_CASE("povray: a box has walls and edges, but none in front of the grains, and lengths above POV-Ray's smallest") {
  const Written written("povray");
  const std::string text = written.text("still.pov");
  double eye[3] = {};
  const std::size_t camera = text.find("location Unit * <");
  REQUIRE(camera != std::string::npos);
  REQUIRE(std::sscanf(text.c_str() + camera, "location Unit * <%lf, %lf, %lf>", &eye[0], &eye[1], &eye[2]) == 3);
  const std::size_t walls = text.find("// walls"), end = text.find("//", walls + 3);
  REQUIRE(end != std::string::npos);
  const std::string part = text.substr(walls, end - walls);
  CHECK(count_of(part, "triangle {") == 4);  // of eight
  CHECK(count_of(part, "cylinder {") == 8);
  for (std::size_t at = part.find("triangle {"); at != std::string::npos; at = part.find("triangle {", at + 1)) {
    Eigen::Matrix3d corners;
    REQUIRE(std::sscanf(part.c_str() + at, "triangle { <%lf, %lf, %lf>, <%lf, %lf, %lf>, <%lf, %lf, %lf> }", &corners(0, 0),
                        &corners(1, 0), &corners(2, 0), &corners(0, 1), &corners(1, 1), &corners(2, 1), &corners(0, 2),
                        &corners(1, 2), &corners(2, 2)) == 9);
    const Vector3 normal = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
    CHECK(normal.dot(Vector3::Map(eye) - corners.col(0)) > 0);
  }
  double unit = 0;
  REQUIRE(std::sscanf(text.c_str() + text.find("#declare Unit"), "#declare Unit = %lf;", &unit) == 1);
  CHECK(unit * written.scene().smallest_half_axis() == doctest::Approx(10));
  CHECK(count_of(text, "scale Unit") ==
        count_of(text, "object { Kind") + count_of(text, "cylinder {") + count_of(text, "\nmesh {"));
}

TEST_CASE("povray: the walls of a box and of a hopper's tray are in the picture") {
  for (const Container& container : {Container(Box{{0.1, 0.1}}), Container(Hopper{0.05, 30, 0.1, 0.1, 12, 0.05, 0.15, 0})}) {
    const std::string text = Written("povray", {}, container).text("still.pov");
    const auto read = [&text](std::size_t after, const char* name, const char* format) {
      Vector3 v = Vector3::Zero();
      std::sscanf(text.c_str() + text.find(name, after), format, &v[0], &v[1], &v[2]);
      return v;
    };
    const Vector3 eye = read(0, "location", "location Unit * <%lf, %lf, %lf>");
    const Vector3 back = (eye - read(0, "look_at", "look_at Unit * <%lf, %lf, %lf>")).normalized();
    const Vector3 high = read(0, "max(", "max(%lf, %lf"), right = Vector3::UnitZ().cross(back).normalized();
    const std::size_t walls = text.find("// walls");
    int corners = 0;
    for (std::size_t at = text.find("cylinder {", walls); at < text.find("// ", walls + 3); at = text.find("cylinder {", at + 1)) {
      const Vector3 to = read(at, "cylinder", "cylinder { <%lf, %lf, %lf>") - eye;
      CHECK(std::abs(to.dot(right)) <= -to.dot(back) * high[1] * (1 + 1e-12));
      CHECK(std::abs(to.dot(back.cross(right))) <= -to.dot(back) * high[0] * (1 + 1e-12));
      ++corners;
    }
    CHECK(corners == 8);
  }
}

TEST_CASE("pictures show each body at its own size") {
  const std::vector<double> scales = {1, 2, 0.5, 1, 1};
  {
    const Written written("glb", scales);
    const tinygltf::Model model = read_glb(written.path("scene.glb"));
    CHECK(model.meshes.size() == 5);  // still one a kind
    CHECK(model.nodes[0].scale.empty());
    CHECK(model.nodes[1].scale == std::vector{2.0, 2.0, 2.0});
    CHECK(model.nodes[2].scale == std::vector{0.5, 0.5, 0.5});
  }
  {
    const Written written("page", scales);
    const std::string text = written.text("view.html");
    CHECK(text.find(R"("scales":"AACAPwAAAEAAAAA/AACAPwAAgD8=")") != std::string::npos);  // floats in base 64
    CHECK(Written("page").text("view.html").find(R"("scales":)") == std::string::npos);
  }
  {
    const Written written("vtk", scales);
    const std::string grains = written.text("vtk/grains_000000.vtp");
    const std::vector<double> half_axes = read_array(grains, "half_axes");
    const std::vector<double> rounding = read_array(grains, "rounding");
    for (std::size_t k = 0; k < kBodies; ++k) {
      const GrainKind& kind = written.scene().kinds[k % 2].kind;
      CHECK(half_axes[3 * k] == scales[k] * kind.half_axes[0]);
      CHECK(rounding[k] == scales[k] * kind.rounding);
    }
    CHECK(grains.find("Name=\"grain\"") == std::string::npos);
  }
  {
    const Written written("povray", scales);
    const std::string text = written.text("still.pov");
    std::size_t at = text.find("object { Kind");
    for (std::size_t k = 0; k < kBodies; ++k, at = text.find("object { Kind", at + 1)) {
      std::array<double, 9> m{};
      REQUIRE(std::sscanf(text.c_str() + text.find('<', at), "<%lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf", &m[0], &m[1], &m[2],
                          &m[3], &m[4], &m[5], &m[6], &m[7], &m[8]) == 9);
      for (std::size_t row = 0; row < 9; row += 3) {
        CHECK(std::hypot(m.at(row), m.at(row + 1), m.at(row + 2)) == doctest::Approx(scales[k]).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("a scene can name all formats of pictures, and no others") {
  std::vector<std::string_view> names;
  for (const PictureFormat& format : picture_formats()) names.push_back(format.name);
  CHECK(std::ranges::equal(names, kPictureNames));
  for (const std::string& name : default_pictures()) CHECK(find_picture_format(name) != nullptr);
}

TEST_CASE("a file that cannot be written is named") {
  const Scene scene = scene_of_two_kinds();
  TemporaryFolder folder;
  OutputFolder out(folder.path(), "pictures", result_names());
  for (const PictureFormat& format : picture_formats()) {
    if (format.files.size() != 1) continue;
    const std::filesystem::path path = out.file(std::string(format.files.front()));
    std::filesystem::create_directory(path);  // in its place
    const auto write = [&] {
      const Contents contents{&scene, {0, 1, 0, 1, 0}};
      const std::unique_ptr<Picture> picture = format.make(out, format, contents);
      picture->add(frame_at(0));
      picture->finish("");
    };
    CHECK_THROWS_WITH_AS(write(), doctest::Contains(path.c_str()), std::runtime_error);
  }
}
