// The last frame of a run as a POV-Ray scene.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <supernormal/shapes/tessellation.hpp>
#include <vector>

#include "base/write_file.hpp"
#include "common/interval.hpp"
#include "frame.hpp"
#include "model/grain_shape.hpp"
#include "picture.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

/// still.pov: the last frame for POV-Ray, and still.png, if povray is installed. Superellipsoids are exact; a grain with rounded
/// edges is a mesh. Each kind has a colour (colour_of_kind). Walls are transparent, except the floor and the dish.
class PovrayScene final : public Picture {
 public:
  PovrayScene(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override { last_ = frame; }
  void finish(const std::string& summary) override;
  std::vector<Rendering> renderings() const override;

 private:
  std::filesystem::path path_;
  const Contents& contents_;
  Frame last_;
};

using supernormal::Vector3;

// Relative to the smallest half-axis: finer than a pixel of a picture of a bed.
constexpr double kStillChordError = 0.005;

// The smallest half-axis in POV-Ray's units. POV-Ray leaves out shadows that are cast from nearer than 0.001 units. In metres,
// grains of millimetres would have bright spots beside their contacts.
constexpr double kUnits = 10;

std::string vector(const auto& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "<" : ", ") + shortest(number);
  return text + '>';
}

std::string vector(const Vector3& v) { return vector(std::array{v.x(), v.y(), v.z()}); }

/// POV-Ray's superellipsoid has half-axes 1 and the exponents 2/e of its xy-section and 2/n along z.
std::string superellipsoid(const ConvexBody& body) {
  return "superellipsoid { " + vector(std::array{2 / body.delta, 2 / body.epsilon}) + " scale " + vector(body.half_axes) + " }";
}

/// An exact capsule along z.
std::string capsule(const ConvexBody& body) {
  const double radius = body.half_axes[0];
  const std::string top = vector(std::array{0.0, 0.0, body.half_axes[2] - radius});
  const std::string bottom = vector(std::array{0.0, 0.0, radius - body.half_axes[2]});
  std::string text = "merge { sphere { " + top + ", " + shortest(radius) + " }";
  if (body.half_axes[2] > radius) {
    text +=
        " sphere { " + bottom + ", " + shortest(radius) + " } cylinder { " + bottom + ", " + top + ", " + shortest(radius) + " }";
  }
  return text + " }";
}

std::string mesh(const GrainKind& kind) {
  const supernormal::Tessellation body = mesh_of(kind, kStillChordError);
  const auto list = [](const char* name, const auto& items, const auto& text_of) {
    std::string text = std::string("  ") + name + " { " + std::to_string(items.size());
    for (const auto& item : items) text += ",\n    " + text_of(item);
    return text + "\n  }\n";
  };
  const auto of_vector = [](const Vector3& v) { return vector(v); };
  const auto of_triangle = [](const std::array<std::uint32_t, 3>& corners) { return vector(corners); };
  return "mesh2 {\n" + list("vertex_vectors", body.points, of_vector) + list("normal_vectors", body.normals, of_vector) +
         list("face_indices", body.triangles, of_triangle) + "}";
}

std::string shape(const GrainKind& kind) {
  if (!kind.components.empty() || kind.rounding > 0) return mesh(kind);
  const ConvexBody body = kind.all_components().front().body;
  return kind.is_capsule ? capsule(body) : superellipsoid(body);
}

/// The positions of the vertices of a wall. Walls of infinite height are shown up to `top` (m).
std::vector<Vector3> vertices_of(const WallPicture& wall, const WallPlace& place, double top) {
  std::vector<Vector3> vertices;
  vertices.reserve(wall.mesh.vertices.size());
  for (const auto& vertex : wall.mesh.vertices) {
    vertices.push_back(to_vector(place(vertex)));
    if (wall.name == "walls") vertices.back().z() = std::min(vertices.back().z(), top);
  }
  return vertices;
}

struct Camera {
  Vector3 eye;
  double line;       // m, half the width of a line, which is about two pixels wide
  std::string text;  // camera and lights
};

/// A wall. The floor, the dish and walls without drawn edges are solid; other walls are transparent and have edges. Walls between
/// the eye and the grains have edges only: grains on them protrude by their overlap, and would show as spots.
std::string container(const WallPicture& wall, const std::vector<Vector3>& vertices, const Camera& camera) {
  const bool is_solid = wall.edges.empty() || wall.name == "floor" || wall.name == "dish";
  const auto is_shown = [&](const std::array<unsigned int, 3>& corners) {
    const auto& [a, b, c] = corners;
    const Vector3 normal = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
    return is_solid || wall.two_sided || normal.dot(camera.eye - vertices[a]) > 0;
  };
  std::string text = "\n// " + wall.name + "\n", triangles;
  for (const auto& corners : wall.mesh.triangles) {
    const auto& [a, b, c] = corners;
    if (!is_shown(corners)) continue;
    triangles += "  triangle { " + vector(vertices[a]) + ", " + vector(vertices[b]) + ", " + vector(vertices[c]) + " }\n";
  }
  if (!triangles.empty()) {
    text += "mesh {\n" + triangles +
            (is_solid ? "  pigment { rgb 0.9 }\n  finish { ambient 0.1 diffuse 0.8 }\n"
                      : "  pigment { rgbt <0.75, 0.8, 0.86, 0.85> }\n  finish { ambient 0.1 diffuse 0.5 }\n  no_shadow\n") +
            "  scale Unit\n}\n";
  }
  for (const auto& [a, b] : wall.edges) {
    if (is_solid) break;
    text += "cylinder { " + vector(vertices[a]) + ", " + vector(vertices[b]) + ", " + shortest(camera.line) +
            " pigment { rgb 0.55 } no_shadow scale Unit }\n";
  }
  return text;
}

/// A camera to the side and above. All grains and the points of `held` just fit into the picture, whatever its aspect ratio.
Camera camera_on(const Frame& frame, double radius, const std::vector<Vector3>& held) {
  const Extent extent = extent_of(frame, radius);
  const Vector3 least = to_vector(extent.least), most = to_vector(extent.most), centre = 0.5 * (least + most);
  const double size = (most - least).norm();
  const Vector3 back = Vector3(0.45, -0.75, 0.48).normalized();
  const Vector3 right = Vector3::UnitZ().cross(back).normalized(), up = back.cross(right);
  const Vector3 eye = centre + 2 * size * back;
  // Half the width and the height of the picture at a distance of 1.
  double width = 0, height = 0;
  const auto hold = [&](const Vector3& point, double around) {
    const Vector3 from_eye = point - eye;
    const double distance = -from_eye.dot(back) - around;
    width = std::max(width, (std::abs(from_eye.dot(right)) + around) / distance);
    height = std::max(height, (std::abs(from_eye.dot(up)) + around) / distance);
  };
  for (const GrainState& grain : frame.grains) {
    if (grain.is_present) hold(to_vector(grain.position), radius);
  }
  for (const Vector3& point : held) hold(point, 0);
  const Vector3 light = centre + 4 * size * Vector3(0.1, -0.5, 0.85).normalized();
  const std::string side = shortest(size / 2);
  // The mirrored x makes POV-Ray's frame right-handed.
  constexpr double kLine = 1e-3;
  return {eye, kLine * size,
          "#declare Aspect = image_width / image_height;\n#declare High = max(" + shortest(height) + ", " + shortest(width) +
              " / Aspect);\ncamera {\n  location Unit * " + vector(eye) +
              "\n  sky z\n  right -x * 2 * High * Aspect\n  up y * 2 * High\n  look_at Unit * " + vector(centre) +
              "\n}\nlight_source { Unit * " + vector(light) + " rgb 1 area_light Unit * " + side + " * x, Unit * " + side +
              " * y, 4, 4 adaptive 1 jitter }\nlight_source { Unit * " + vector(eye) +
              " rgb 0.35 shadowless }\nbackground { rgb 1 }\n"};
}

}  // namespace

PovrayScene::PovrayScene(const std::filesystem::path& path, const Contents& contents) : path_(path), contents_(contents) {}

void PovrayScene::finish(const std::string& /*summary*/) {
  const double radius = contents_.scene->largest_bounding_radius();
  const double top = extent_of(last_, radius).most[2];
  std::vector<std::vector<Vector3>> vertices;  // of each wall
  std::vector<Vector3> held;
  for (std::size_t i = 0; i < contents_.walls.size(); ++i) {
    const WallPicture& wall = contents_.walls[i];
    const std::vector<Vector3>& last = vertices.emplace_back(vertices_of(wall, last_.wall_places[i], top));
    if (wall.name == "walls" || wall.role == WallPicture::Role::Cell) held.insert(held.end(), last.begin(), last.end());
  }
  const Camera camera = camera_on(last_, radius, held);
  // A ray passes more walls than POV-Ray's default of five; beyond them the picture would be black.
  std::string text = "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 50 }\n#declare Unit = " +
                     shortest(kUnits / contents_.scene->smallest_half_axis()) + "; // of POV-Ray, in a metre\n" + camera.text;
  for (std::size_t i = 0; i < contents_.walls.size(); ++i) {
    if (last_.wall_places[i].scale == 0) continue;  // the wall was removed
    text += container(contents_.walls[i], vertices[i], camera);
  }
  for (std::size_t index = 0; index < contents_.scene->kinds.size(); ++index) {
    const GrainKind& kind = contents_.scene->kinds[index].kind;
    text += "\n// " + kind.name + "\n#declare Kind" + std::to_string(index) + " = object {\n" + shape(kind) +
            "\n  pigment { srgb " + vector(colour_of_kind(index)) +
            " }\n  finish { ambient 0.1 diffuse 0.8 specular 0.15 roughness 0.03 }\n}\n";
  }
  text += '\n';
  for (std::size_t k = 0; k < last_.grains.size(); ++k) {
    const GrainState& grain = last_.grains[k];
    if (!grain.is_present) continue;
    const auto& [w, x, y, z] = grain.quaternion;
    const supernormal::Matrix3 R = Eigen::Quaterniond(w, x, y, z).toRotationMatrix();
    std::vector<double> rows;  // of POV-Ray's matrix: the images of the axes, then of the origin
    for (const int axis : {0, 1, 2}) {
      const Vector3 column = contents_.scale(k) * R.col(axis);
      rows.insert(rows.end(), column.begin(), column.end());
    }
    rows.insert(rows.end(), grain.position.begin(), grain.position.end());
    text += "object { Kind" + std::to_string(contents_.kind_of_grain[k]) + " matrix " + vector(rows) + " scale Unit }\n";
  }
  write_file(path_, text);
}

std::vector<Rendering> PovrayScene::renderings() const {
  const std::string scene = path_.filename().string();
  // One thread: with several threads the pixels depend on their order.
  return {{"still.png", {"povray", "+I" + scene, "+O-", "+FN", "+W900", "+H560", "+A0.2", "-D", "+WT1"}, "", "povray"}};
}

PictureFormat povray_format() { return {"povray", {"still.pov"}, make_file<PovrayScene>, {"still.png"}}; }

}  // namespace falling_particles
