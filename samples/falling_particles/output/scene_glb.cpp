// The animation of a run as a glTF file.

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <supernormal/shapes/tessellation.hpp>
#include <vector>

#include "base/write_file.hpp"
#include "frame.hpp"
#include "model/grain_shape.hpp"
#include "picture.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

/// scene.glb: glTF 2.0, binary. It has a mesh per kind of grain with smooth normals. Each grain is a node, in the order of the
/// indices, with the mesh of its kind and a scale for its size. The translations and rotations of moving grains are animated;
/// absent grains have scale 0. Each wall is a node, which is scaled when it changes. A root node rotates the z-axis upwards.
/// A bond is a node with a line of length 1 from the centre of a grain along z, turned and scaled to the centre of the other.
/// A wall has the colours and numbers of the first field with numbers on it, at the end of the run.
/// Lengths are in m. The file is written at the end of a run; until then a grain needs 28 bytes per frame.
class SceneGlb final : public Picture {
 public:
  SceneGlb(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  /// The poses of a node, frame by frame.
  struct Track {
    std::vector<float> translations;  // x, y, z
    std::vector<float> rotations;     // x, y, z, w
    std::vector<float> scales;        // along x, y, z

    void add(const Point& position, const std::array<double, 4>& quaternion, double scale);
    void repeat_last(double scale);
    /// Inserts `frames` frames before the first one; in these the node is absent.
    void precede(std::size_t frames);
  };
  void add_grain(std::size_t grain, const GrainState& state);

  std::filesystem::path path_;
  const Contents& contents_;
  std::vector<float> times_;
  std::vector<Track> grains_;
  std::vector<Track> walls_;           // of the walls
  std::vector<Track> bonds_;           // of the bonds
  std::vector<TriangleField> fields_;  // of the last frame
};

// Relative to the smallest half-axis of a grain: most grains have a few hundred triangles and no visible edges.
constexpr double kAnimationChordError = 0.02;

constexpr std::array<double, 4> kBondColour = {0.6, 0.02, 0.1, 1};  // linear

constexpr std::array<double, 4> kWallColour = {0.25, 0.3, 0.37, 0.16};  // linear, and transparent

/// Builds the glTF model.
class Builder {
 public:
  Builder(const Contents& contents, const std::vector<TriangleField>& fields) {
    model_.asset.version = "2.0";
    model_.asset.generator = "falling_particles";
    model_.buffers.resize(1);
    for (std::size_t index = 0; index < contents.scene->kinds.size(); ++index) add_kind(contents.scene->kinds[index].kind, index);
    for (std::size_t wall = 0; wall < contents.walls.size(); ++wall) add_wall(contents.walls[wall], field_on(wall, fields));
    if (!contents.bonds.empty())
      add_wall({"bond", WallPicture::Role::Still, {{{0, 0, 0}, {0, 0, 1}}, {}}, {{0, 1}}}, {}, kBondColour);
    add_nodes(contents);
  }

  void start_animation(const std::vector<float>& times) {
    animation_.name = "run";
    view_ = add_view(0);
    input_ = add_accessor(view_, times, TINYGLTF_TYPE_SCALAR);
    model_.accessors[static_cast<std::size_t>(input_)].minValues = {times.front()};
    model_.accessors[static_cast<std::size_t>(input_)].maxValues = {times.back()};
  }

  /// Adds the tracks of a node with the numbers of all times. Constant tracks are left out.
  void move(std::size_t node, const std::vector<float>& translations, const std::vector<float>& rotations) {
    animate(node, "translation", add_moving(translations, 3), "LINEAR");
    animate(node, "rotation", add_moving(rotations, 4), "LINEAR");
  }

  /// Animates the scale. A grain or a lid appears or vanishes at once; a cell shrinks continuously.
  void resize(std::size_t node, const std::vector<float>& scales) {
    const bool vanishes = std::ranges::find(scales, 0) != scales.end();
    animate(node, "scale", add_moving(scales, 3), vanishes ? "STEP" : "LINEAR");
  }

  void end_animation() {
    if (!animation_.channels.empty()) model_.animations.push_back(std::move(animation_));
  }

  void place(std::size_t node, std::span<const float> translation, std::span<const float> rotation) {
    model_.nodes[node].translation.assign(translation.begin(), translation.end());
    model_.nodes[node].rotation.assign(rotation.begin(), rotation.end());
  }

  void scale(std::size_t node, std::span<const float> scale) { model_.nodes[node].scale.assign(scale.begin(), scale.end()); }

  void write(const std::filesystem::path& path) {
    std::ofstream stream(path, std::ios::binary);
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, false, true);
    close_or_throw(stream, path);
  }

 private:
  /// A section of the buffer, which its accessors fill one after the other.
  std::size_t add_view(int target) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = model_.buffers[0].data.size();
    view.target = target;
    model_.bufferViews.push_back(view);
    return model_.bufferViews.size() - 1;
  }

  template <typename Number>
  int add_accessor(std::size_t view, const std::vector<Number>& numbers, int type) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(view);
    accessor.byteOffset = data.size() - model_.bufferViews[view].byteOffset;
    accessor.componentType = std::is_same_v<Number, float> ? TINYGLTF_COMPONENT_TYPE_FLOAT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = type;
    accessor.count = numbers.size() / static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    model_.bufferViews[view].byteLength += numbers.size() * sizeof(Number);
    const std::size_t start = data.size();
    data.resize(start + numbers.size() * sizeof(Number));
    std::memcpy(data.data() + start, numbers.data(), numbers.size() * sizeof(Number));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size() - 1);
  }

  /// -1 if all frames have the numbers of the first one.
  int add_moving(const std::vector<float>& numbers, std::size_t components) {
    const auto repeats = [&](std::size_t k) { return numbers[k] == numbers[k % components]; };
    bool is_still = true;
    for (std::size_t k = 0; k < numbers.size() && is_still; ++k) is_still = repeats(k);
    if (is_still) return -1;
    return add_accessor(view_, numbers, components == 3 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4);
  }

  void animate(std::size_t node, const char* path, int output, const char* interpolation) {
    if (output < 0) return;
    tinygltf::AnimationSampler sampler;
    sampler.input = input_;
    sampler.output = output;
    sampler.interpolation = interpolation;
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation_.samplers.size());
    channel.target_node = static_cast<int>(node);
    channel.target_path = path;
    animation_.samplers.push_back(std::move(sampler));
    animation_.channels.push_back(std::move(channel));
  }

  int add_vectors(const std::vector<supernormal::Vector3>& vectors) {
    std::vector<float> numbers;
    numbers.reserve(3 * vectors.size());
    for (const supernormal::Vector3& vector : vectors) {
      for (const int i : {0, 1, 2}) numbers.push_back(static_cast<float>(vector[i]));
    }
    const std::size_t view = add_view(TINYGLTF_TARGET_ARRAY_BUFFER);
    return add_accessor(view, numbers, TINYGLTF_TYPE_VEC3);
  }

  void add_kind(const GrainKind& kind, std::size_t index) {
    const supernormal::Tessellation body = mesh_of(kind, kAnimationChordError);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(index);
    const int positions = add_vectors(body.points);
    bound(model_.accessors[static_cast<std::size_t>(positions)], body);
    primitive.attributes["POSITION"] = positions;
    primitive.attributes["NORMAL"] = add_vectors(body.normals);
    primitive.indices = add_indices(body.triangles);
    tinygltf::Mesh mesh;
    mesh.name = kind.name;
    mesh.primitives.push_back(std::move(primitive));
    model_.meshes.push_back(std::move(mesh));
    const auto& [red, green, blue] = colour_of_kind(index);
    add_material(kind.name, {std::pow(red, 2.2), std::pow(green, 2.2), std::pow(blue, 2.2), 1}, 0.6, "OPAQUE");
  }

  static void bound(tinygltf::Accessor& positions, const supernormal::Tessellation& body) {
    for (const int i : {0, 1, 2}) {
      const auto along = [i](const auto& a, const auto& b) { return a[i] < b[i]; };
      const auto [least, most] = std::minmax_element(body.points.begin(), body.points.end(), along);
      positions.minValues.push_back(static_cast<float>((*least)[i]));
      positions.maxValues.push_back(static_cast<float>((*most)[i]));
    }
  }

  int add_indices(const auto& tuples) {
    std::vector<std::uint32_t> corners;
    for (const auto& tuple : tuples) corners.insert(corners.end(), tuple.begin(), tuple.end());
    return add_accessor(add_view(TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), corners, TINYGLTF_TYPE_SCALAR);
  }

  /// The numbers of a field on a wall.
  struct WallField {
    std::string name;
    std::vector<double> numbers;  // of the triangles; empty without a field
    double most = 0;              // on any wall
  };

  /// The first field that has numbers on the wall.
  static WallField field_on(std::size_t wall, const std::vector<TriangleField>& fields) {
    const auto found = std::ranges::find_if(fields, [&](const TriangleField& field) { return !field.of_walls[wall].empty(); });
    if (found == fields.end()) return {};
    WallField field{found->name, found->of_walls[wall]};
    for (const std::vector<double>& numbers : found->of_walls) {
      for (const double number : numbers) field.most = std::max(field.most, number);
    }
    return field;
  }

  /// Adds a wall: transparent triangles, and edges as lines. Viewers compute flat normals for triangles without normals.
  void add_wall(const WallPicture& wall, const WallField& field, const std::array<double, 4>& colour = kWallColour) {
    tinygltf::Mesh mesh;
    mesh.name = wall.name;
    const int positions = add_points(wall.mesh.vertices);
    const auto add = [&](const auto& tuples, int mode) {
      if (tuples.empty()) return;
      tinygltf::Primitive primitive;
      primitive.mode = mode;
      primitive.material = static_cast<int>(model_.materials.size());
      primitive.attributes["POSITION"] = positions;
      primitive.indices = add_indices(tuples);
      mesh.primitives.push_back(std::move(primitive));
    };
    if (field.numbers.empty()) add(wall.mesh.triangles, TINYGLTF_MODE_TRIANGLES);
    add(wall.edges, TINYGLTF_MODE_LINE);
    add_material(wall.name, colour, 1, "BLEND");
    if (!field.numbers.empty()) add_coloured(wall, field, mesh);
    model_.meshes.push_back(std::move(mesh));
  }

  /// Adds triangles with vertices of their own, each with a colour and its number. The colour runs from the one of other walls at
  /// 0 to red at the largest number.
  void add_coloured(const WallPicture& wall, const WallField& field, tinygltf::Mesh& mesh) {
    constexpr std::array<double, 4> kMost = {0.8, 0.05, 0.02, 1};  // linear, and opaque
    std::vector<std::array<float, 3>> corners;
    std::vector<float> colours, numbers;
    for (std::size_t k = 0; k < wall.mesh.triangles.size(); ++k) {
      const double fraction = field.most > 0 ? field.numbers[k] / field.most : 0;
      for (const unsigned int vertex : wall.mesh.triangles[k]) {
        corners.push_back(wall.mesh.vertices[vertex]);
        numbers.push_back(static_cast<float>(field.numbers[k]));
        for (std::size_t i = 0; i < 4; ++i) colours.push_back(static_cast<float>(std::lerp(kWallColour[i], kMost[i], fraction)));
      }
    }
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(model_.materials.size());
    primitive.attributes["POSITION"] = add_points(corners);
    primitive.attributes["COLOR_0"] = add_accessor(add_view(TINYGLTF_TARGET_ARRAY_BUFFER), colours, TINYGLTF_TYPE_VEC4);
    primitive.attributes['_' + field.name] = add_accessor(add_view(TINYGLTF_TARGET_ARRAY_BUFFER), numbers, TINYGLTF_TYPE_SCALAR);
    mesh.primitives.push_back(std::move(primitive));
    add_material(wall.name + ' ' + field.name, {1, 1, 1, 1}, 1, "BLEND");  // a factor on the colours
  }

  int add_points(const std::vector<std::array<float, 3>>& vertices) {
    supernormal::Tessellation points;
    for (const auto& [x, y, z] : vertices) points.points.emplace_back(x, y, z);
    const int positions = add_vectors(points.points);
    bound(model_.accessors[static_cast<std::size_t>(positions)], points);
    return positions;
  }

  /// `colour`: linear.
  void add_material(std::string name, const std::array<double, 4>& colour, double roughness, const char* alpha) {
    tinygltf::Material& material = model_.materials.emplace_back();
    material.name = std::move(name);
    material.pbrMetallicRoughness.baseColorFactor.assign(colour.begin(), colour.end());
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = roughness;
    material.alphaMode = alpha;
  }

  /// Adds a node per grain, then a node per wall, then a node per bond, then the root above them.
  void add_nodes(const Contents& contents) {
    tinygltf::Node root;
    root.name = contents.scene->name;
    root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // in glTF y points upwards
    for (std::size_t grain = 0; grain < contents.kind_of_grain.size(); ++grain) {
      tinygltf::Node node;
      node.name = contents.kind(grain).name + " " + std::to_string(grain);
      node.mesh = static_cast<int>(contents.kind_of_grain[grain]);
      if (const double scale = contents.scale(grain); scale != 1) node.scale.assign(3, scale);
      model_.nodes.push_back(std::move(node));
      root.children.push_back(static_cast<int>(grain));
    }
    for (std::size_t k = 0; k < contents.walls.size() + contents.bonds.size(); ++k) {
      const std::size_t mesh = std::min(k, contents.walls.size());  // all bonds have one
      tinygltf::Node node;
      node.name = k < contents.walls.size() ? contents.walls[k].name : "bond " + std::to_string(k - mesh);
      node.mesh = static_cast<int>(contents.scene->kinds.size() + mesh);
      root.children.push_back(static_cast<int>(model_.nodes.size()));
      model_.nodes.push_back(std::move(node));
    }
    model_.nodes.push_back(std::move(root));
    tinygltf::Scene scene;
    scene.name = contents.scene->name;
    scene.nodes = {static_cast<int>(model_.nodes.size() - 1)};
    model_.scenes.push_back(std::move(scene));
    model_.defaultScene = 0;
  }

  tinygltf::Model model_;
  tinygltf::Animation animation_;
  std::size_t view_ = 0;  // of the animation
  int input_ = 0;         // the times of the animation
};

}  // namespace

void SceneGlb::Track::add(const Point& position, const std::array<double, 4>& quaternion, double scale) {
  for (const double x : position) translations.push_back(static_cast<float>(x));
  // Quaternions are w, x, y, z there. Of the two quaternions of an orientation, takes the one nearer to the last: players
  // interpolate between them.
  const auto& [w, x, y, z] = quaternion;
  const std::array<double, 4> now = {x, y, z, w};
  double along = 0;
  for (std::size_t i = 0; i < 4 && rotations.size() >= 4; ++i) along += now[i] * rotations[rotations.size() - 4 + i];
  for (const double component : now) rotations.push_back(static_cast<float>(along < 0 ? -component : component));
  scales.insert(scales.end(), 3, static_cast<float>(scale));
}

void SceneGlb::Track::repeat_last(double scale) {
  const auto repeat = [](std::vector<float>& numbers, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(numbers[numbers.size() - count]);
  };
  repeat(translations, 3);
  repeat(rotations, 4);
  scales.insert(scales.end(), 3, static_cast<float>(scale));
}

void SceneGlb::Track::precede(std::size_t frames) {
  const std::vector<float> first_translation(translations.begin(), translations.begin() + 3);
  const std::vector<float> first_rotation(rotations.begin(), rotations.begin() + 4);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    translations.insert(translations.begin(), first_translation.begin(), first_translation.end());
    rotations.insert(rotations.begin(), first_rotation.begin(), first_rotation.end());
  }
  scales.insert(scales.begin(), 3 * frames, 0);
}

SceneGlb::SceneGlb(const std::filesystem::path& path, const Contents& contents)
    : path_(path), contents_(contents), walls_(contents.walls.size()) {}

void SceneGlb::add(const Frame& frame) {
  times_.push_back(static_cast<float>(frame.time));
  for (std::size_t grain = 0; grain < frame.grains.size(); ++grain) add_grain(grain, frame.grains[grain]);
  for (std::size_t wall = 0; wall < walls_.size(); ++wall) {
    const WallPlace& place = frame.wall_places[wall];
    walls_[wall].add(place.position, place.quaternion, place.scale);
  }
  fields_ = frame.fields;
  bonds_.resize(contents_.bonds.size());
  for (std::size_t k = 0; k < bonds_.size(); ++k) {
    const auto& [first, second, until] = contents_.bonds[k];
    if (until <= frame.time) {
      bonds_[k].repeat_last(0);
      continue;
    }
    const Point& from = frame.grains[first].position;
    const Vector3 along = to_vector(frame.grains[second].position) - to_vector(from);
    const auto turn = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), along);
    bonds_[k].add(from, {turn.w(), turn.x(), turn.y(), turn.z()}, along.norm());
  }
}

void SceneGlb::add_grain(std::size_t grain, const GrainState& state) {
  const double scale = contents_.scale(grain);
  if (grain < grains_.size()) {
    if (state.is_present) return grains_[grain].add(state.position, state.quaternion, scale);
    return grains_[grain].repeat_last(0);
  }
  Track& track = grains_.emplace_back();
  track.add(state.position, state.quaternion, state.is_present ? scale : 0);
  track.precede(times_.size() - 1);
}

void SceneGlb::finish(const std::string& /*summary*/) {
  Builder builder(contents_, fields_);
  std::size_t node = 0;
  for (const std::vector<Track>* tracks : {&grains_, &walls_, &bonds_}) {
    for (const Track& track : *tracks) {
      builder.place(node++, std::span(track.translations).first(3), std::span(track.rotations).first(4));
    }
  }
  for (std::size_t wall = 0; wall < walls_.size(); ++wall) {
    builder.scale(grains_.size() + wall, std::span(walls_[wall].scales).first(3));
  }
  for (std::size_t grain = 0; grain < grains_.size(); ++grain) {
    if (grains_[grain].scales.front() == 0) builder.scale(grain, std::span(grains_[grain].scales).first(3));
  }
  const std::size_t first_bond = grains_.size() + walls_.size();
  for (std::size_t k = 0; k < bonds_.size(); ++k) builder.scale(first_bond + k, std::span(bonds_[k].scales).first(3));
  if (times_.size() > 1) {
    builder.start_animation(times_);
    node = 0;
    for (const std::vector<Track>* tracks : {&grains_, &walls_, &bonds_}) {
      for (const Track& track : *tracks) builder.move(node++, track.translations, track.rotations);
    }
    for (std::size_t wall = 0; wall < walls_.size(); ++wall) builder.resize(grains_.size() + wall, walls_[wall].scales);
    for (std::size_t grain = 0; grain < grains_.size(); ++grain) builder.resize(grain, grains_[grain].scales);
    for (std::size_t k = 0; k < bonds_.size(); ++k) builder.resize(first_bond + k, bonds_[k].scales);
    builder.end_animation();
  }
  builder.write(path_);
}

PictureFormat glb_format() { return {"glb", {"scene.glb"}, make_file<SceneGlb>}; }

}  // namespace falling_particles
