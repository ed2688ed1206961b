// Doubts about what quickstep cannot hold on the lightest grains: heavy grains, and parts that press.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/grain_shape.hpp"
#include "model/wall.hpp"

namespace falling_particles {
namespace {

/// The heaviest and the lightest grain of a scene.
struct Extremes {
  const GrainCount* heavy = nullptr;
  const GrainCount* light = nullptr;
  double most = 0;   // kg
  double least = 0;  // kg

  double size() const { return light->smallest_scale() * light->kind.smallest_half_axis(); }         // m
  double diameter() const { return std::cbrt(6 / std::numbers::pi * least / light->kind.density); }  // m, as a sphere
};

Extremes extremes_of(const Scene& scene) {
  Extremes found;
  for (const GrainCount& entry : scene.kinds) {
    if (!scene.has_grains_of(entry)) continue;
    const double mass = mass_of(entry.kind);
    const double most = std::pow(entry.largest_scale(), 3) * mass;
    const double least = std::pow(entry.smallest_scale(), 3) * mass;
    if (found.heavy == nullptr || most > found.most) {
      found.heavy = &entry;
      found.most = most;
    }
    if (found.light == nullptr || least < found.least) {
      found.light = &entry;
      found.least = least;
    }
  }
  return found;
}

/// A remedy in a list of them; none above the most iterations that a scene may have.
std::string more_iterations(double fewest) {
  return fewest > Solver::kMostIterations ? "" : ", solver.iterations from " + std::to_string(std::lround(fewest)) + " on";
}

/// m/s, of the correction of overlaps; infinite without a limit.
double largest_correcting_velocity(const Scene& scene) {
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const auto* const limit = std::get_if<supernormal::effects::MaxCorrectingVelocity>(&effect);
    if (limit != nullptr) return limit->velocity;
  }
  return INFINITY;
}

// Adds a doubt if the heaviest grain sinks into the lightest ones. A light grain of mass m bears the part q m of it. An iteration
// of projected Gauss-Seidel on its two contacts leaves q / (1 + q) of the error, the squared coupling of the two rows over the
// product of their diagonals. After n iterations from 0 the heavy grain still falls with the fraction f = (q / (1 + q))^n of its
// weight. It rests where the correction of its overlap makes up for this: (1 - f) erp depth / step = f g step. grains.md, "Large
// and small grains", has the measurements.
void add_mass_ratio(const Extremes& grains, const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kDeep = 0.01;  // of the light grain's smallest half-axis: about 1 % of the bed's volume
  constexpr double kBearers = 4;  // light grains that bear a heavy one; a bed below them spreads the load
  const double gravity = scene.gravity() == nullptr ? 0 : scene.gravity()->acceleration.norm();
  const double step = scene.time.step;
  const int iterations = scene.solver.iterations;
  const double part = grains.most / grains.least / kBearers;                    // q
  const double remainder = 1 / std::expm1(iterations * std::log1p(1 / part));   // f / (1 - f)
  const double unit = gravity * step * step / scene.solver.erp;                 // m; depth for the remainder 1
  const double by_depth = kDeep * grains.size() / unit;                         // the largest remainder
  const double by_speed = largest_correcting_velocity(scene) / gravity / step;  // that no depth makes up for
  const double allowed = std::min(by_depth, by_speed);
  if (!(remainder > allowed)) return;
  const double longest = step * std::min(std::sqrt(by_depth / remainder), by_speed / remainder);
  doubts.push_back(
      "the heaviest grain (\"" + grains.heavy->kind.name + "\") has " + rounded(grains.most / grains.least) +
      " times the mass of the lightest (\"" + grains.light->kind.name +
      "\"): with solver.iterations = " + std::to_string(iterations) + " it sinks into such grains " +
      (remainder > by_speed ? "until more than four bear it"
                            : "by about " + rounded(unit * remainder / grains.size()) + " of their smallest half-axis") +
      "; time.step up to " + rounded(longest) + " s" + more_iterations(std::ceil(std::log1p(1 / allowed) / std::log1p(1 / part))) +
      ", or densities with masses up to 1 : " + rounded(kBearers / std::expm1(std::log1p(1 / allowed) / iterations)) +
      " would do (grains.md)");
}

/// Pa, with which a part presses: a servo's stress, otherwise the force and the weight over the plan of the container. 0 for a part
/// that stands, is moved, turns, or pulls.
double pressure_of(const Wall& part, double plan, const Scene& scene) {
  if (part.drive && part.drive->servo) return part.drive->servo->stress;
  if (!part.flight && (!part.drive || part.drive->turns())) return 0;
  const auto* const gravity = scene.gravity();
  const Vector3 acceleration = gravity == nullptr ? Vector3::Zero() : gravity->acceleration;
  if (part.flight) return part.flight->mass * acceleration.norm() / plan;
  return std::abs(part.drive->force + part.drive->mass * acceleration.dot(part.drive->axis)) / plan;
}

/// m^3, of all grains at the start.
double volume_of_grains(const Scene& scene) {
  double volume = 0;
  for (const GrainCount& entry : scene.kinds) {
    for (int i = 0; i < entry.count; ++i) {
      volume += std::pow(entry.scale(static_cast<std::size_t>(i)), 3) * mass_of(entry.kind) / entry.kind.density;
    }
  }
  return volume;
}

/// Adds a doubt about a part that presses harder than quickstep can carry. A step starts without forces, and an iteration carries
/// them from layer to layer. The force pressure x diameter^2 would move a free grain by force x step^2 / mass. Beds hold it if this
/// is below kHeld half-axes x iterations / layers^2. parts.md, "How hard a part may press", has the measurement.
void add_pressure(const Wall& part, const Extremes& grains, const Scene& scene, WallDoubts& doubts) {
  constexpr double kHeld = 0.05;   // beds give way from 0.15 on; twice as much is silent about 0.08 half-axes, 4 layers deep
  constexpr double kPacked = 0.6;  // volume fraction of a bed
  const double diameter = grains.diameter();
  const auto [x, y] = plan_of(scene.container).width;
  const double pressure = pressure_of(part, x * y, scene);
  const double layers = std::max(1.0, volume_of_grains(scene) / (kPacked * x * y * diameter));
  const double way = pressure * diameter * diameter * scene.time.step * scene.time.step / grains.least;
  const double held = kHeld * grains.size() * scene.solver.iterations / (layers * layers);
  if (!(way > held)) return;
  const double excess = way / held;
  doubts.add("pressing", part, excess,
             " presses with " + rounded(pressure) + " Pa on about " + rounded(layers) + (layers == 1 ? " layer" : " layers") +
                 " of grains: a free grain would move by " + rounded(way) + " m in a step, " + in_half_axes(way, scene) +
                 ", and solver.iterations = " + std::to_string(scene.solver.iterations) + " hold " + rounded(held / grains.size()) +
                 ": they may overlap, and be pressed through walls; time.step up to " +
                 rounded(scene.time.step / std::sqrt(excess)) + " s" +
                 more_iterations(std::ceil(scene.solver.iterations * excess)) + ", or up to " + rounded(pressure / excess) +
                 " Pa would do (parts.md)");
}

}  // namespace

void add_doubts_about_loads(const Scene& scene, std::vector<std::string>& doubts) {
  const Extremes grains = extremes_of(scene);
  if (grains.heavy == nullptr || grains.light == nullptr || has_springs(scene) || scene.compression || scene.solver.stepper) return;
  if (scene.solver.erp == 0) {
    doubts.emplace_back("solver.erp is 0: overlaps are never corrected, and grains sink; 0.2 would do");
    return;
  }
  add_mass_ratio(grains, scene, doubts);
  WallDoubts of_walls;
  for (const Wall& part : scene.parts()) add_pressure(part, grains, scene, of_walls);
  of_walls.tell(doubts);
}

}  // namespace falling_particles
