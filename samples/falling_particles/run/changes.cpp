#include "changes.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "advise/refusals.hpp"
#include "base/toml_input.hpp"
#include "common/input_error.hpp"
#include "common/nearest_word.hpp"
#include "input/load_sections.hpp"
#include "model/container.hpp"

namespace falling_particles {
namespace {

enum class WallChange { Motion, Drive };

/// What an assignment changes.
struct Change {
  bool needs_new_world = false;    // effects and solver
  std::vector<std::string> walls;  // by their names
  WallChange of_walls = WallChange::Motion;
};

/// The keys of a drive that may change. The inertia, the axis and the stops are those of the joint at the start.
constexpr std::array kDriveKeys = {"force", "torque", "power", "largest_force", "largest_torque", "stress", "damping", "until"};

std::string keys_that_change(const Scene& scene) {
  std::vector<std::string> keys = effect_sections();
  keys.emplace_back("solver");
  if (std::holds_alternative<Drum>(scene.container)) keys.emplace_back("container.rpm");
  std::vector<std::string> walls = {"part[NAME]"};
  if (std::holds_alternative<Cell>(scene.container)) walls.emplace_back("container.SIDE");
  for (const std::string& wall : walls) {
    keys.push_back(wall + ".motion");
    for (const char* key : kDriveKeys) keys.push_back(wall + ".drive." + key);
  }
  return join(keys);
}

[[noreturn]] void refuse_key(const std::string& key, const Scene& scene) {
  throw InputError(key + " is fixed during a run; allowed to change: " + keys_that_change(scene));
}

/// Of a motion or a drive of a wall. `rest`: the key after the name of the wall.
Change change_of_wall(const std::string& key, std::string name, std::string_view rest, const Scene& scene) {
  const bool is_motion = rest.starts_with(".motion") && rest.find_first_of(kNameCharacters, 7) != 7;
  constexpr std::string_view kDrive = ".drive.";
  const bool is_drive = rest.starts_with(kDrive) && std::ranges::find(kDriveKeys, rest.substr(kDrive.size())) != kDriveKeys.end();
  if (!is_motion && !is_drive) refuse_key(key, scene);
  return {false, {std::move(name)}, is_motion ? WallChange::Motion : WallChange::Drive};
}

Change change_of_container(const std::string& key, std::string_view name, const Scene& scene) {
  const std::string_view side = name.substr(0, name.find('.'));
  if (std::holds_alternative<Cell>(scene.container) && side.size() < name.size()) {
    return change_of_wall(key, std::string(side), name.substr(side.size()), scene);
  }
  if (!std::holds_alternative<Drum>(scene.container) || name != "rpm") refuse_key(key, scene);
  Change change;
  for (const Wall& wall : walls_in(scene.container)) {
    if (!wall.motions.empty()) change.walls.push_back(wall.name);
  }
  return change;
}

/// `rest`: the key after "part".
Change change_of_part(const std::string& key, std::string_view rest, const Scene& scene) {
  const std::size_t closing = rest.find(']');
  if (!rest.starts_with('[') || closing == std::string_view::npos) refuse_key(key, scene);
  const std::string name(rest.substr(1, closing - 1));
  rest.remove_prefix(closing + 1);
  const std::vector<std::string> names = names_of(scene.parts());
  if (std::ranges::find(names, name) == names.end()) {
    throw InputError(key + ": there is no part \"" + name + '"' + did_you_mean(name, names) +
                     (names.empty() ? "; the scene has no parts" : "; allowed: " + join(names)));
  }
  return change_of_wall(key, name, rest, scene);
}

Change change_of(const std::string& assignment, const Scene& scene) {
  const std::string key = assignment.substr(0, assignment.find('='));
  const std::size_t end = std::min(key.find_first_of(".["), key.size());
  const std::string section = key.substr(0, end);
  if (section == "container" && end < key.size()) return change_of_container(key, std::string_view(key).substr(end + 1), scene);
  if (section == "part") return change_of_part(key, std::string_view(key).substr(end), scene);
  const std::vector<std::string> effects = effect_sections();
  if (section != "solver" && std::ranges::find(effects, section) == effects.end()) refuse_key(key, scene);
  return {true, {}, {}};
}

/// Starts the motions now, where the wall is.
void change_motions(Wall& wall, const Wall& changed, double now) {
  const WallPose pose = pose_at(wall.start, wall.motions, now);
  if (wall.drive) {
    const Eigen::Quaterniond turn = pose.rotation * wall.start.rotation.conjugate();
    wall.drive->axis = turn * wall.drive->axis;
    if (wall.drive->turns()) wall.drive->point = pose.position + turn * (*wall.drive->point - wall.start.position);
  }
  wall.start = pose;
  wall.motions = changed.motions;
  std::erase_if(wall.motions, [now](const WallMotion& motion) { return motion.until <= now; });
  for (WallMotion& motion : wall.motions) motion.from = std::max(motion.from, now);
  if (!wall.moves()) wall.motions.push_back({.kind = Translation{supernormal::Vector3::Zero()}, .from = now});  // may move again
}

void change_drive(Drive& drive, const Drive& changed) {
  drive.force = changed.force;
  drive.power = changed.power;
  if (drive.servo) drive.servo->stress = changed.servo->stress;
  drive.damping = changed.damping;
  drive.until = changed.until;
}

void require_like(const Wall& wall, const Wall& changed, WallChange change) {
  if (change == WallChange::Motion && !wall.moves()) {
    throw InputError("part[" + wall.name + "].motion: the part stood at the start; allowed: a part with a motion or a drive then");
  }
  if (change == WallChange::Drive && (!wall.drive || !changed.drive)) {
    throw InputError("part[" + wall.name + "].drive: the part had no drive at the start; allowed: a part with a drive then");
  }
  if (change == WallChange::Drive &&
      (wall.drive->turns() != changed.drive->turns() || wall.drive->servo.has_value() != changed.drive->servo.has_value())) {
    throw InputError("part[" + wall.name +
                     "].drive: another kind of drive than at the start; allowed: other values of the same kind");
  }
}

}  // namespace

void change_values(StepwiseRun& run, Scene& scene, const std::vector<std::string>& assignments,
                   const std::function<Scene()>& load) {
  std::vector<Change> changes;
  changes.reserve(assignments.size());
  for (const std::string& assignment : assignments) changes.push_back(change_of(assignment, scene));
  const Scene changed = load();
  const auto is_of = [](const Change& change, const Wall& wall) {
    return std::ranges::find(change.walls, wall.name) != change.walls.end();
  };
  for (const Change& change : changes) {
    for (std::size_t i = 0; i < scene.walls.size(); ++i) {
      if (is_of(change, scene.walls[i])) require_like(scene.walls[i], changed.walls[i], change.of_walls);
    }
  }
  if (!scene.bonds.empty()) refuse_stiff_bonds(run.simulation().world, changed.solver.iterations);
  const double now = run.step() * scene.time.step;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    Wall& wall = scene.walls[i];
    const auto changes_in = [&](WallChange kind) {
      return std::ranges::any_of(changes, [&](const Change& change) { return change.of_walls == kind && is_of(change, wall); });
    };
    if (changes_in(WallChange::Motion)) change_motions(wall, changed.walls[i], now);
    if (changes_in(WallChange::Drive)) change_drive(*wall.drive, *changed.walls[i].drive);
  }
  if (std::ranges::none_of(changes, &Change::needs_new_world)) return;
  run.change(changed.effects, [&] {
    scene.effects = changed.effects;
    scene.solver = changed.solver;
  });
}

}  // namespace falling_particles
