// Doubts about a start from the state of another run, which holds grains alone: about the bonds and the parts of that run.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "doubts.hpp"
#include "input/state_table.hpp"
#include "model/wall_doubts.hpp"

namespace falling_particles {
namespace {

/// The rows of a table that the run has left beside its state; nothing without the table, or for a file of another form.
void read_beside(const Scene& scene, const char* name, StateTable::Frames frames, const std::vector<std::string>& columns,
                 const std::function<void(const StateTable&, const StateTable::Row&)>& read) {
  const std::filesystem::path file = scene.start->file.parent_path() / name;
  if (!std::filesystem::is_regular_file(file)) return;
  try {
    const StateTable table(file, frames);
    table.require(columns);
    for (const StateTable::Row& row : table.rows()) read(table, row);
  } catch (const InputError&) {
    return;  // a file of the user's with this name, or a table without lines
  }
}

/// The numbers of bonds in a table of a run, by the names of their sections.
std::map<std::string, std::size_t> bonds_in(const Scene& scene, const char* name) {
  std::map<std::string, std::size_t> numbers;
  read_beside(scene, name, StateTable::Frames::All, {"bond", "body_1", "body_2"},
              [&](const StateTable& table, const StateTable::Row& row) { ++numbers[std::string(table.word(row, "bond"))]; });
  return numbers;
}

/// The path that a scene names a file beside the state by, relative to the scene.
std::string in_scene(const Scene& scene, const char* name) {
  const std::filesystem::path folder = std::filesystem::path(scene.path).parent_path();
  return (scene.start->file.parent_path() / name).lexically_proximate(folder).string();
}

/// Adds doubts about sections whose bonds the run has strained or broken, and which bond the grains anew.
void add_new_bonds(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr const char* kLeft = "final_bonds.csv";
  std::map<std::string, std::size_t> left = bonds_in(scene, kLeft);
  const std::map<std::string, std::size_t> broken = bonds_in(scene, "broken_bonds.csv");
  const std::string file = (scene.start->file.parent_path() / kLeft).string();
  for (const BondRule& rule : scene.bonds) {
    const std::size_t number = left[rule.name];
    left.erase(rule.name);
    if (!rule.file.empty()) continue;
    const std::string anew = "bond \"" + rule.name + "\" bonds the grains of start.file anew, without strain, by bond." +
                             (rule.touching ? "touching" : "chain") + ": ";
    if (number > 0) {
      doubts.push_back(anew + file + " has " + counted(number, "bond") + " of this name with unstrained poses; bond[" + rule.name +
                       "].file = \"" + in_scene(scene, kLeft) + "\" would do (bonds.md)");
    } else if (const auto all = broken.find(rule.name); all != broken.end()) {
      doubts.push_back(anew + "all bonds of this name broke in the run before (" + std::to_string(all->second) +
                       "); the scene without this section would do (bonds.md)");
    }
  }
  for (const auto& [name, number] : left) {
    std::string loose = file + " has " + counted(number, "bond") + " of the name \"";
    loose.append(name).append(
        "\", and the scene has no section [[bond]] of this name: their grains start loose; the section of the ");
    loose.append("run before, with bond[").append(name).append("].file = \"").append(in_scene(scene, kLeft));
    doubts.push_back(loose + "\", would do (bonds.md)");
  }
}

/// m, how far the surface of a wall is from where it was. Planes, which have no end, are compared within the plan of the container.
double way_from(const WallPose& left, const Wall& wall, const Scene& scene) {
  if (const auto* const plane = std::get_if<PlaneShape>(&wall.shape)) {
    const Vector3 then = left.rotation * plane->normal, now = wall.start.rotation * plane->normal;
    const Rectangle plan = plan_of(scene.container);
    const double turn = std::atan2(then.cross(now).norm(), then.dot(now));
    return std::abs(then.dot(wall.start.position - left.position)) + std::hypot(plan.width[0], plan.width[1]) * turn;
  }
  const double turn = left.rotation.angularDistance(wall.start.rotation);
  return (left.position - wall.start.position).norm() + (turn > 0 ? bounding_radius(wall.shape) * turn : 0);
}

constexpr int kDigits = 7;  // a part of a metre has the place of its grains to 0.1 um

std::string list(const Vector3& v) {
  return '[' + rounded(v.x(), kDigits) + ", " + rounded(v.y(), kDigits) + ", " + rounded(v.z(), kDigits) + ']';
}

/// The keys that put a part where it was left.
std::string keys_of(const WallPose& left, const Wall& part) {
  const std::string position = "part.position = " + list(left.position);
  constexpr double kRounding = 1e-7;  // rad
  if (left.rotation.angularDistance(part.start.rotation) < kRounding) return position;
  const Eigen::AngleAxisd turn(left.rotation);
  return position + ", part.axis = " + list(turn.axis()) +
         " and part.angle = " + rounded(turn.angle() * 180 / std::numbers::pi, kDigits);
}

/// The keys of a cell whose sides stay upright, from where the run has left them.
std::string keys_of(const std::map<std::string, WallPose>& poses, const Cell& cell) {
  const auto& [corner, size] = cell.start;
  std::array<double, 3> low = corner, length = size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto place = [&](const char* end, double otherwise) {
      const auto found = poses.find(std::string(1, "xyz"[axis]) + end);
      return found == poses.end() ? otherwise : found->second.position[static_cast<Eigen::Index>(axis)];
    };
    low[axis] = place("_low", corner[axis]);
    length[axis] = place("_high", corner[axis] + size[axis]) - low[axis];
  }
  std::string keys = "container.corner = " + list({low[0], low[1], low[2]}) + ", container.width = [" +
                     rounded(length[0], kDigits) + ", " + rounded(length[1], kDigits) + ']';
  if (cell.has_lid()) keys += ", container.height = " + rounded(length[2], kDigits);
  return keys;
}

/// Adds doubts about walls that do not start where the run has left them.
void add_left_walls(const Scene& scene, std::vector<std::string>& doubts) {
  // Of the smallest half-axis. In the scene plate this moves grains as another seed does, 0.02 ten times as far; 0.001 doubts
  // numbers with four digits, 0.1 is silent about three.
  constexpr double kTyped = 0.01;
  std::map<std::string, WallPose> poses;  // by name, in the last frame
  read_beside(
      scene, "parts.csv", StateTable::Frames::Last, {"part", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"},
      [&](const StateTable& table, const StateTable::Row& row) {
        const auto number = [&](const char* column) { return table.number(row, column, Interval::finite("")); };
        const Eigen::Quaterniond rotation(number("qw"), number("qx"), number("qy"), number("qz"));
        poses[std::string(table.word(row, "part"))] = {{number("x_m"), number("y_m"), number("z_m")}, rotation.normalized()};
      });
  const auto* const cell = std::get_if<Cell>(&scene.container);
  WallDoubts of_walls;
  for (const Wall& wall : scene.walls) {
    const auto left = poses.find(wall.name);
    if (left == poses.end()) continue;
    const double way = way_from(left->second, wall, scene);
    if (way <= kTyped * scene.smallest_half_axis()) continue;
    const std::string starts = " starts " + rounded(way) + " m from where " +
                               (scene.start->file.parent_path() / "parts.csv").string() +
                               " leaves it, since start.file has grains alone; ";
    const bool is_upright = left->second.rotation.angularDistance(wall.start.rotation) == 0;
    std::string keys = keys_of(left->second, wall);
    if (wall.is_of_container) {
      keys = cell != nullptr && is_upright ? keys_of(poses, *cell)
                                           : "keys of [container] that put it there, or a run before that ends after whole "
                                             "revolutions and periods";
    }
    // The sides of a cell share their keys.
    of_walls.add(cell != nullptr && wall.is_of_container ? "cell" : wall.name, wall, way, starts + keys + " would do (start.md)");
  }
  of_walls.tell(doubts);
}

}  // namespace

std::vector<std::string> doubts_about_continuation(const Scene& scene) {
  std::vector<std::string> doubts;
  if (!scene.start) return doubts;
  add_new_bonds(scene, doubts);
  add_left_walls(scene, doubts);
  return doubts;
}

}  // namespace falling_particles
