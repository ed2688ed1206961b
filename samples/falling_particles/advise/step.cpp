#include <algorithm>
#include <cmath>
#include <numbers>
#include <supernormal/effects.hpp>
#include <variant>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/grain_shape.hpp"
#include "model/lattice.hpp"

namespace falling_particles {
namespace {

namespace fx = supernormal::effects;

/// m/s, of the grains that a feeder brings.
double speed_of(const Feeder& feeder) { return std::hypot(feeder.velocity[0], feeder.velocity[1], feeder.velocity[2]); }

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

// Adds a doubt about a step in which gravity moves grains so far from rest that their beds sink. A start on a lattice without
// look-ahead has the doubt about its fall.
void add_sinking(const Scene& scene, std::vector<std::string>& doubts) {
  const double longest = longest_step(scene, scene.looks_ahead());
  if (scene.time.step <= longest) return;
  const std::optional<Fall> fall = fall_from_start(scene);
  if (!scene.looks_ahead() && fall && fall->way > scene.smallest_half_axis()) return;
  const double way = scene.gravity()->acceleration.norm() * scene.time.step * scene.time.step;
  doubts.push_back("from rest, grains fall " + rounded(way) + " m in a step, " + in_half_axes(way, scene) +
                   ": their beds sink and shake; time.step up to " + rounded(longest) + " s would do");
}

/// m/s, of grains that meet, as far as it is known: of a fall from the start, of a state, and of feeders.
double largest_speed(const Scene& scene) {
  const std::optional<Fall> fall = fall_from_start(scene);
  double largest = std::max(fall ? fall->speed : 0, scene.start ? scene.start->largest_speed() : 0);
  for (const Feeder& feeder : scene.feeders) largest = std::max(largest, speed_of(feeder));
  return largest;
}

/// N/m, of contacts of two grains of this mass (kg), at the depth of their fastest impact; 0 without springs. Hertz's energy is
/// 8/15 E* sqrt(R) depth^2.5, and its stiffness grows with the depth.
double stiffness_of(const fx::Effect& effect, double mass, const Scene& scene) {
  if (const auto* const spring = std::get_if<fx::Compliance>(&effect)) return spring->stiffness;
  const auto* const hertz = std::get_if<fx::Hertz>(&effect);
  if (hertz == nullptr) return 0;
  const double speed = largest_speed(scene);
  const double stiffness = contact_modulus(*hertz) * std::sqrt(scene.smallest_half_axis() / 2);
  return 2 * stiffness * std::pow(15 * mass / 2 * speed * speed / (16 * stiffness), 0.2);
}

/// Adds a doubt about springs between whose touch and rest the lightest grains have fewer than ten steps: they are implicit in
/// part, and lose energy (README.md of lib/effects, "Springs"). The run counts those contacts, and those off the centre are
/// shorter.
void add_coarse_springs(const Scene& scene, std::vector<std::string>& doubts) {
  double mass = INFINITY;
  for (const GrainCount& entry : scene.kinds) {
    if (scene.has_grains_of(entry)) mass = std::min(mass, std::pow(entry.smallest_scale(), 3) * mass_of(entry.kind));
  }
  for (const fx::Effect& effect : scene.effects) {
    const double steps = std::numbers::pi / scene.time.step * std::sqrt(mass / 2 / stiffness_of(effect, mass, scene));
    if (!(steps < fx::kLeastContactSteps)) continue;
    doubts.push_back("two of the lightest grains may touch for " + rounded(steps) +
                     " steps, and springs lose energy in contacts of fewer than ten steps; time.step up to " +
                     rounded(scene.time.step * steps / fx::kLeastContactSteps) + " s, or a lower stiffness would do");
  }
}

}  // namespace

bool has_springs(const Scene& scene) {
  return std::ranges::any_of(scene.effects, [](const fx::Effect& effect) {
    return std::holds_alternative<fx::Compliance>(effect) || std::holds_alternative<fx::Hertz>(effect);
  });
}

std::string in_half_axes(double way, const Scene& scene) {
  return rounded(way / scene.smallest_half_axis()) + " of the smallest half-axis (" + rounded(scene.smallest_half_axis(), 6) +
         " m)";
}

std::string moves_too_far(const std::string& who, double way, const Scene& scene) {
  return who + " " + rounded(way) + " m in a step, " + in_half_axes(way, scene) + ": it may pass through what is in its way; ";
}

double longest_step(const Scene& scene, bool looks_ahead) {
  constexpr double kFar = 0.1;      // of the smallest half-axis; twice as far, beds sink by up to 0.2 of it
  constexpr double kFarAhead = 10;  // the same for grains that look ahead, which sink by up to 0.12
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr || has_springs(scene) || scene.compression) return INFINITY;
  return std::sqrt((looks_ahead ? kFarAhead : kFar) * scene.smallest_half_axis() / gravity->acceleration.norm());
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
    add_fast("grains of feeder \"" + feeder.name + "\" move", speed_of(feeder), "", scene, doubts);
  }
  add_coarse_springs(scene, doubts);
}

}  // namespace falling_particles
