#include <algorithm>
#include <cmath>
#include <variant>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/lattice.hpp"

namespace falling_particles {
namespace {

/// Adds a doubt about a time that is no multiple of the step.
void add_rounded_times(const Time& time, std::vector<std::string>& doubts) {
  constexpr double kRounding = 1e-6;  // of a step, for typed numbers
  const auto add = [&](const char* key, double value, int steps) {
    if (std::abs(value - steps * time.step) <= kRounding * time.step) return;
    doubts.push_back(std::string(key) + " is " + shortest(value) + " s, no multiple of time.step: it is rounded to " +
                     counted(static_cast<std::size_t>(steps), "step") + "; a multiple of " + shortest(time.step) + " s would do");
  };
  add("time.duration", time.duration, time.steps());
  add("time.frame", time.frame, time.steps_per_frame());
}

bool starts_on_lattice(const Scene& scene) {
  return scene.grains_at_start() > 0 && !scene.start && !std::holds_alternative<Periodic>(scene.container);
}

// m, the largest way along gravity from the lattice, which fills the plan, to the end of the room; infinite where the container is
// open. 0 without gravity, and where grains do not start on a lattice.
double height_of_fall(const Scene& scene) {
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr || !starts_on_lattice(scene)) return 0;
  const Lattice lattice = filled_lattice(scene);
  const auto* const cell = std::get_if<Cell>(&scene.container);  // its planes are around the start
  const Region room = cell != nullptr ? cell->start : room_of(scene.container);
  double height = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double down = gravity->acceleration[axis] / gravity->acceleration.norm();
    if (!(std::abs(down) > 0)) continue;
    // The bounds of an open container may be far below all parts, on which grains land.
    const bool is_bottomless = axis == 2 && is_open(scene.container);
    const double low = is_bottomless ? lowest_start(scene.container) : room.corner[axis],
                 high = room.corner[axis] + room.size[axis];
    const double first = axis == 2 ? lattice.corner()[2] : low, last = axis == 2 ? lattice.top() : high;
    height += down > 0 ? down * (high - first) : -down * (last - low);
  }
  return height;
}

// Adds a doubt about a scene without gravity in which nothing else moves grains.
void add_gravity(const Scene& scene, std::vector<std::string>& doubts) {
  const bool is_at_rest = starts_on_lattice(scene) && scene.feeders.empty() && std::ranges::none_of(scene.walls, &Wall::moves);
  if (scene.gravity() == nullptr && is_at_rest) {
    doubts.emplace_back("the scene has no section [gravity]: grains stay where they start, and nothing moves them");
  }
}

/// Adds a doubt about grains that may pass through something, which grains that look ahead do not. `remedy`: besides a step.
void add_fast(const std::string& who, double speed, const std::string& remedy, const Scene& scene,
              std::vector<std::string>& doubts) {
  if (scene.looks_ahead() || speed * scene.time.step <= scene.smallest_half_axis()) return;
  doubts.push_back(moves_too_far(who, speed * scene.time.step, scene) + remedy + "time.step up to " +
                   rounded(scene.smallest_half_axis() / speed) + " s would do");
}

// Adds a doubt about a step in which gravity moves grains so far from rest that their beds sink. README.md, "Before a run", has the
// measurement. A start on a lattice without look-ahead has the doubt about its fall.
void add_sinking(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kFar = 0.1;      // of the smallest half-axis; twice as far, beds sink by up to 0.2 of it
  constexpr double kFarAhead = 10;  // the same for grains that look ahead, which sink by up to 0.12
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr || has_springs(scene) || scene.compression) return;
  const std::optional<Fall> fall = fall_from_start(scene);
  if (!scene.looks_ahead() && fall && fall->way > scene.smallest_half_axis()) return;
  const double acceleration = gravity->acceleration.norm();
  const double way = acceleration * scene.time.step * scene.time.step;
  const double most = (scene.looks_ahead() ? kFarAhead : kFar) * scene.smallest_half_axis();
  if (way <= most) return;
  doubts.push_back("from rest, grains fall " + rounded(way) + " m in a step, " + in_half_axes(way, scene) +
                   ": their beds sink and shake; time.step up to " + rounded(std::sqrt(most / acceleration)) + " s would do");
}

}  // namespace

bool is_spring(const supernormal::effects::Effect& effect) {
  return std::holds_alternative<supernormal::effects::Compliance>(effect) ||
         std::holds_alternative<supernormal::effects::Hertz>(effect);
}

bool has_springs(const Scene& scene) { return std::ranges::any_of(scene.effects, is_spring); }

std::string in_half_axes(double way, const Scene& scene) {
  return rounded(way / scene.smallest_half_axis()) + " of the smallest half-axis (" + rounded(scene.smallest_half_axis(), 6) +
         " m)";
}

std::string moves_too_far(const std::string& who, double way, const Scene& scene) {
  return who + " " + rounded(way) + " m in a step, " + in_half_axes(way, scene) + ": it may pass through what is in its way; ";
}

std::optional<Fall> fall_from_start(const Scene& scene) {
  const double height = height_of_fall(scene);
  if (!(height > 0 && std::isfinite(height))) return std::nullopt;
  const double speed = std::sqrt(2 * scene.gravity()->acceleration.norm() * height);
  return Fall{height, speed, speed * scene.time.step};
}

void add_doubts_about_step(const Scene& scene, std::vector<std::string>& doubts) {
  add_rounded_times(scene.time, doubts);
  add_gravity(scene, doubts);
  if (const std::optional<Fall> fall = fall_from_start(scene)) {
    add_fast("from the start grains fall up to " + rounded(fall->height) + " m, and without drag its last grains fall with " +
                 rounded(fall->speed) + " m/s,",
             fall->speed, "a container with a larger plan, feeders, or ", scene, doubts);
  }
  if (scene.start) add_fast("the fastest grain of start.file moves", scene.start->largest_speed(), "", scene, doubts);
  add_sinking(scene, doubts);
  for (const Feeder& feeder : scene.feeders) {
    const double speed = std::hypot(feeder.velocity[0], feeder.velocity[1], feeder.velocity[2]);
    add_fast("grains of feeder \"" + feeder.name + "\" move", speed, "", scene, doubts);
  }
}

}  // namespace falling_particles
