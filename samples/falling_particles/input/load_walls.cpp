#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/mesh.hpp"
#include "load_sections.hpp"
#include "model/container.hpp"
#include "model/two_sided_mesh.hpp"
#include "model/wall.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace falling_particles {
namespace {

const std::vector<std::string> kShapes = {"plane", "box", "cylinder", "mesh", "ellipsoid", "superellipsoid", "superovoid"};

/// The keys of a shape.
std::vector<std::string> keys_of_shape(const std::string& shape) {
  if (shape == "box") return {"size"};
  if (shape == "cylinder") return {"radius", "length"};
  if (shape == "mesh") return {"file", "unit", "two_sided"};
  if (shape == "ellipsoid") return {"half_axes"};
  if (shape == "superellipsoid") return {"half_axes", "delta", "epsilon"};
  if (shape == "superovoid") return {"half_axes", "delta", "epsilon", "taper"};
  return {};
}

std::vector<std::string> with_common_keys(std::vector<std::string> keys) {
  for (const char* key : {"name", "shape", "position", "axis", "angle", "friction", "restitution", "motion", "drive", "free"})
    keys.emplace_back(key);
  return keys;
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  for (const std::string& shape : kShapes) {
    for (std::string& key : keys_of_shape(shape)) {
      if (std::ranges::find(keys, key) == keys.end()) keys.push_back(std::move(key));
    }
  }
  return with_common_keys(std::move(keys));
}

Vector3 read_sizes(const TomlTable& table, const char* key) {
  return read_vector(table, key, Interval::positive(kLargestLength, "m"));
}

SmoothShape read_smooth(const TomlTable& table, const std::string& shape) {
  SmoothShape body{read_sizes(table, "half_axes")};
  if (shape == "ellipsoid") return body;
  body.delta = table.number("delta", Interval::closed(1.01, 1000, ""));
  body.epsilon = table.number("epsilon", Interval::closed(1.01, 1000, ""));
  if (shape == "superellipsoid") return body;
  const std::vector<double> taper = table.numbers("taper", 2, Interval::closed(-1, 1, ""));
  body.taper_x = taper[0];
  body.taper_y = taper[1];
  try {
    const supernormal::Superovoid checked(body.half_axes, body.delta, body.epsilon, body.taper_x, body.taper_y);
  } catch (const std::invalid_argument& error) {
    table.refuse("taper", std::string(": ") + error.what());
  }
  return body;
}

/// The number of triangles that occur in both windings. In a single-sided mesh, each winding pushes grains behind it to its front.
/// So grains sink in from both sides, up to the middle.
std::size_t count_two_sided(const Mesh& mesh) {
  const auto from_lowest = [](std::array<unsigned int, 3> corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
  };
  std::set<std::array<unsigned int, 3>> seen;
  for (const auto& triangle : mesh.triangles) seen.insert(from_lowest(triangle));
  return static_cast<std::size_t>(std::ranges::count_if(seen, [&](const auto& t) {
    return t[1] < t[2] && seen.contains({t[0], t[2], t[1]});
  }));
}

MeshShape read_mesh(const TomlTable& table, const std::string& scene_path) {
  constexpr std::array<std::pair<const char*, double>, 4> kUnits = {{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}}};
  const std::string unit = table.choice("unit", {"m", "cm", "mm", "inch"});
  const std::string name = table.text("file");
  std::string extension = std::filesystem::path(name).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".stl" && extension != ".obj") {
    table.refuse("file", " is \"" + name + "\"; allowed: an .stl or .obj file, its path relative to the scene file");
  }
  const auto* const found = std::ranges::find(kUnits, unit, [](const auto& entry) { return std::string(entry.first); });
  MeshShape mesh;
  mesh.two_sided = table.has("two_sided") && table.boolean("two_sided");
  try {
    static_cast<Mesh&>(mesh) = load_mesh((std::filesystem::path(scene_path).parent_path() / name).string(), found->second);
    if (mesh.two_sided) mesh.triangles = sheets_of(mesh).triangles;
  } catch (const std::runtime_error& error) {
    table.refuse("file", std::string(": ") + error.what());
  }
  if (bounding_radius(mesh) > kLargestLength) {
    table.refuse("unit", " is \"" + unit + "\", with which the mesh reaches " + shortest(bounding_radius(mesh)) +
                             " m from its origin; allowed: up to " + shortest(kLargestLength) + " m");
  }
  if (const std::size_t count = count_two_sided(mesh); count > 0) {
    table.refuse("file", ": \"" + name + "\" has " + counted(count, "triangle") +
                             " with corners in both orders, between which grains would sink; allowed: each triangle "
                             "once, solid behind, or " +
                             table.full_name("two_sided") + " = true, which holds grains on both sides");
  }
  return mesh;
}

WallShape read_shape(const TomlTable& table, const std::string& scene_path) {
  const std::string shape = table.choice("shape", kShapes);
  table.refuse_unknown_keys(with_common_keys(keys_of_shape(shape)));
  if (shape == "plane") return PlaneShape{};
  if (shape == "box") return BoxShape{read_sizes(table, "size")};
  if (shape == "cylinder") {
    return CylinderShape{table.number("radius", Interval::positive(kLargestLength, "m")),
                         table.number("length", Interval::positive(kLargestLength, "m"))};
  }
  if (shape == "mesh") return read_mesh(table, scene_path);
  return read_smooth(table, shape);
}

WallPose read_pose(const TomlTable& table) {
  WallPose pose;
  if (table.has("position")) pose.position = read_vector(table, "position", Interval::closed(-kLargestLength, kLargestLength, "m"));
  if (!table.has("axis") && !table.has("angle")) return pose;
  const double angle = table.number("angle", Interval::closed(-360, 360, "degrees about part.axis"));
  pose.rotation = Eigen::AngleAxisd(angle * std::numbers::pi / 180, read_direction(table, "axis"));
  return pose;
}

/// Reads a name, which must fit into a field of parts.csv.
std::string read_name(const TomlTable& table, const std::vector<Wall>& walls) {
  const std::string name = table.text("name");
  const auto is_allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  if (!std::ranges::all_of(name, is_allowed)) {
    table.refuse("name", " is \"" + name + "\"; allowed: letters, digits, _, - and .");
  }
  if (const auto other = std::ranges::find(walls, name, &Wall::name); other != walls.end()) {
    const char* const owner = other->is_of_container ? "a wall of the container" : "another part";
    table.refuse("name", " is \"" + name + "\", which " + owner + " has; allowed: a name of its own");
  }
  return name;
}

/// Reads how a wall moves, and what grains on it feel. `between`: of a servo without an area.
void read_conduct(const TomlTable& table, const Time& time, const std::vector<FacingWalls>& between, Wall& wall) {
  if (table.has("motion")) wall.motions = read_motions(table, time);
  wall.drive = read_drive(table, wall, between);
  if (table.has("friction")) wall.friction = table.number("friction", Interval::positive(100, ""));
  if (table.has("restitution")) wall.restitution = table.number("restitution", Interval::positive(1, ""));
}

Wall read_wall(const TomlTable& table, const std::vector<Wall>& walls, const Time& time, const std::string& scene_path) {
  Wall wall{read_name(table, walls), read_shape(table, scene_path)};
  wall.start = read_pose(table);
  read_conduct(table, time, {}, wall);
  wall.flight = read_flight(table, wall, time);
  return wall;
}

/// Reads the sides of a cell. A servo of one of them is between the other ones.
void read_sides(const TomlTable& table, const Cell& cell, const Time& time, std::vector<Wall>& walls) {
  std::vector<FacingWalls> pairs = {{"x_low", "x_high"}, {"y_low", "y_high"}};
  if (cell.has_lid()) pairs.push_back({"z_low", "z_high"});
  for (Wall& wall : walls) {
    const auto side = table.find_table(wall.name, {"motion", "drive", "friction", "restitution"});
    if (!side) continue;
    std::vector<FacingWalls> others = pairs;
    std::erase_if(others, [&](const FacingWalls& pair) { return pair[0] == wall.name || pair[1] == wall.name; });
    read_conduct(*side, time, others.size() == 2 ? others : std::vector<FacingWalls>(), wall);
  }
}

}  // namespace

std::vector<std::pair<TomlTable, std::size_t>> tables_of_walls(const TomlTable& root, const Scene& scene) {
  std::vector<std::pair<TomlTable, std::size_t>> tables;
  const std::vector<TomlTable> parts = root.has("part") ? root.tables("part") : std::vector<TomlTable>();
  const std::size_t of_container = scene.walls.size() - parts.size();
  for (std::size_t i = 0; i < parts.size(); ++i) tables.emplace_back(parts[i], of_container + i);
  if (!std::holds_alternative<Cell>(scene.container)) return tables;
  const TomlTable container = root.table("container");
  for (std::size_t i = 0; i < of_container; ++i) {
    if (container.has(scene.walls[i].name)) tables.emplace_back(container.table(scene.walls[i].name), i);
  }
  return tables;
}

std::vector<Wall> load_walls(const TomlTable& root, const Scene& scene, const std::string& scene_path) {
  std::vector<Wall> walls = walls_in(scene.container);
  if (const auto* cell = std::get_if<Cell>(&scene.container)) read_sides(root.table("container"), *cell, scene.time, walls);
  if (!root.has("part")) return walls;
  if (std::holds_alternative<Periodic>(scene.container)) {
    root.fail("part", "part in a periodic container; allowed: in any other container");
  }
  for (const TomlTable& table : root.tables("part", all_keys())) walls.push_back(read_wall(table, walls, scene.time, scene_path));
  const auto own = std::ranges::count_if(walls, [](const Wall& wall) { return wall.friction || wall.restitution; });
  if (own > kMostWallMaterials) {
    root.fail("part", "the scene has " + std::to_string(own) + " parts with friction or restitution of their own; allowed: up to " +
                          std::to_string(kMostWallMaterials));
  }
  return walls;
}

}  // namespace falling_particles
