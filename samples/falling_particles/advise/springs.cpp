// Doubts about springs of contacts that are too stiff for the step.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <supernormal/effects.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/grain_shape.hpp"
#include "model/wall.hpp"

namespace falling_particles {
namespace {

namespace fx = supernormal::effects;

/// kg m^2, about the centre of a grain of scale 1, along the axes of its frame.
supernormal::Matrix3 inertia_of(const GrainKind& kind) {
  if (!kind.compound_mass) return kind.density * shape_of(kind.all_components().front().body)->mass_properties().inertia();
  supernormal::Matrix3 inertia;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      inertia(i, j) = kind.compound_mass->inertia[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return inertia;
}

/// 1/kg, the largest acceleration of a point of the surface of a free grain along the normal, over a force along it there.
double largest_mobility(const GrainCount& entry) {
  constexpr double kChordError =
      0.002;  // of the smallest half-axis; 0.001 has 1 % fewer steps for a casino die, 0.01 has 15 % more
  const supernormal::Tessellation surface = mesh_of(entry.kind, kChordError);
  const supernormal::Matrix3 inverse = inertia_of(entry.kind).inverse();
  double turning = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vector3 lever = surface.points[i].cross(surface.normals[i]);
    turning = std::max(turning, lever.dot(inverse * lever));
  }
  return (1 / mass_of(entry.kind) + turning) / std::pow(entry.smallest_scale(), 3);
}

/// m/s, of grains that meet, as far as it is known: of a fall from the start, of a state, and of feeders.
double largest_speed(const Scene& scene) {
  const std::optional<Fall> fall = fall_from_start(scene);
  double largest = std::max(fall ? fall->speed : 0, scene.start ? scene.start->largest_speed() : 0);
  for (const Feeder& feeder : scene.feeders) {
    largest = std::max(largest, std::hypot(feeder.velocity[0], feeder.velocity[1], feeder.velocity[2]));
  }
  return largest;
}

/// A section of springs, at their stiffest.
struct Spring {
  std::string key, unit;
  double value;      // of the key
  double stiffness;  // N/m
  double exponent;   // of the stiffness as a power of the value
};

/// `mobility`: 1/kg. Hertz's energy is 8/15 E* sqrt(R) depth^2.5, and its stiffness grows with the depth of the fastest impact.
Spring spring_of(const fx::Effect& effect, const Scene& scene, double mobility) {
  if (const auto* const spring = std::get_if<fx::Compliance>(&effect)) {
    return {"compliance.stiffness", "N/m", spring->stiffness, spring->stiffness, 1};
  }
  const auto& hertz = std::get<fx::Hertz>(effect);
  const double radius = scene.smallest_half_axis() / 2, speed = largest_speed(scene);
  const double modulus = contact_modulus(hertz);
  const double depth = std::pow(15 * speed * speed / (16 * mobility * modulus * std::sqrt(radius)), 0.4);
  return {"hertz.youngs_modulus", "Pa", hertz.youngs_modulus, 2 * modulus * std::sqrt(radius * depth), 0.8};
}

}  // namespace

// README.md of lib/effects, "Springs": with fewer steps the contacts are implicit in part, and lose energy.
void add_doubts_about_springs(const Scene& scene, std::vector<std::string>& doubts) {
  const auto effect = std::ranges::find_if(scene.effects, is_spring);
  if (effect == scene.effects.end()) return;
  std::vector<std::pair<double, std::string>> grains = {{0, "a wall"}};  // 1/kg and names: two of each kind, if there are
  for (const GrainCount& entry : scene.kinds) {
    if (!scene.has_grains_of(entry)) continue;
    grains.insert(grains.end(), entry.count == 1 && scene.feeders.empty() ? 1 : 2,
                  {largest_mobility(entry), '"' + entry.kind.name + '"'});
  }
  if (grains.size() == 1) return;
  std::ranges::sort(grains, std::greater<>());
  const double mobility = grains[0].first + grains[1].first;
  const Spring spring = spring_of(*effect, scene, mobility);
  const double steps = std::numbers::pi / (scene.time.step * std::sqrt(spring.stiffness * mobility));
  if (!(steps < fx::kLeastContactSteps)) return;
  const double shorter = steps / fx::kLeastContactSteps;
  doubts.push_back(spring.key + " of " + rounded(spring.value) + ' ' + spring.unit +
                   " has contacts of fewer than ten steps, which lose energy: " + grains[0].second + " and " + grains[1].second +
                   " may touch for " + rounded(steps) + " steps; time.step up to " + rounded(scene.time.step * shorter) +
                   " s, or " + spring.key + " up to " + rounded(spring.value * std::pow(shorter, 2 / spring.exponent)) + ' ' +
                   spring.unit + ", with deeper overlaps, would do");
}

}  // namespace falling_particles
