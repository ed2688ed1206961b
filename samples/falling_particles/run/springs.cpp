// Doubts about springs of contacts that are too stiff for the step.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <supernormal/effects.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "model/grain_shape.hpp"
#include "output/grain_mesh.hpp"

namespace falling_particles {
namespace {

namespace fx = supernormal::effects;

/// The spring of a contact at its stiffest, and the key of the section that sets it.
struct Spring {
  std::string section, key, unit;
  double value;      // of the key
  double stiffness;  // N/m
  double exponent;   // of the stiffness as a power of the value
  double depth;      // m, of the largest impact
};

bool is_spring(const fx::Effect& effect) {
  return std::holds_alternative<fx::Compliance>(effect) || std::holds_alternative<fx::Hertz>(effect);
}

/// kg m^2, about the centre of a grain of scale 1, along the axes of its frame.
supernormal::Matrix3 inertia_of(const GrainKind& kind) {
  supernormal::Matrix3 inertia;
  if (!kind.compound_mass) return kind.density * shape_of(kind.all_components().front().body)->mass_properties().inertia();
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

/// 1/kg, of a part that is free or slides under a force; 0 for others. A servo on springs has a doubt of its own.
double mobility_of(const Wall& part) {
  if (part.flight) return 1 / part.flight->mass;
  return part.drive && !part.drive->servo && !part.drive->turns() ? 1 / part.drive->mass : 0;
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

/// `mobility`: 1/kg; `speed`: m/s. Hertz's energy is 8/15 E* sqrt(R) depth^2.5.
Spring spring_of(const fx::Effect& effect, const Scene& scene, double mobility, double speed) {
  if (const auto* const spring = std::get_if<fx::Compliance>(&effect)) {
    const double depth = speed / std::sqrt(spring->stiffness * mobility);
    return {"compliance", "stiffness", "N/m", spring->stiffness, spring->stiffness, 1, depth};
  }
  const auto& hertz = std::get<fx::Hertz>(effect);
  const double radius = scene.smallest_half_axis() / 2;
  const double modulus = hertz.youngs_modulus / (1 - hertz.poisson_ratio * hertz.poisson_ratio) / 2;
  const double depth = std::pow(15 * speed * speed / (16 * mobility * modulus * std::sqrt(radius)), 0.4);
  return {"hertz", "youngs_modulus", "Pa", hertz.youngs_modulus, 2 * modulus * std::sqrt(radius * depth), 0.8, depth};
}

/// How much deeper softer springs overlap. `softer`: their value over the scene's. The depth at rest is as 1 / stiffness, and as
/// E^(-2/3) of Hertz; the depth of an impact as stiffness^(-1/2), and as E^(-2/5).
std::string overlaps_of(const Spring& spring, double softer, double speed, const Scene& scene) {
  std::string text = "softer springs overlap " + rounded(std::pow(softer, spring.exponent == 1 ? -1 : -2.0 / 3)) +
                     " times as deep under the same load";
  if (!(speed > 0)) return text;
  const double size = scene.smallest_half_axis();
  return text + ", and by " + rounded(spring.depth * std::pow(softer, -spring.exponent / 2) / size) + " and not " +
         rounded(spring.depth / size) + " of the smallest half-axis in an impact with " + rounded(speed) + " m/s";
}

}  // namespace

// README.md of lib/effects, "Springs": with fewer steps the contacts are implicit in part, and lose energy.
std::vector<std::string> doubts_about_springs(const Scene& scene) {
  const auto effect = std::ranges::find_if(scene.effects, is_spring);
  if (effect == scene.effects.end()) return {};
  std::vector<std::pair<double, std::string>> grains;  // 1/kg and names: two of each kind, if there are
  for (const GrainCount& entry : scene.kinds) {
    if (!scene.has_grains_of(entry)) continue;
    grains.insert(grains.end(), entry.count == 1 && scene.feeders.empty() ? 1 : 2,
                  {largest_mobility(entry), '"' + entry.kind.name + '"'});
  }
  if (grains.empty()) return {};
  std::ranges::sort(grains, std::greater<>());
  const auto& [mobility1, name1] = grains[0];
  auto [mobility2, name2] = grains.size() > 1 ? grains[1] : std::pair(0.0, std::string("a wall"));
  for (const Wall& part : scene.parts()) {
    const double mobility = mobility_of(part);
    if (mobility > mobility2) name2 = part.called();
    mobility2 = std::max(mobility, mobility2);
  }
  const double speed = largest_speed(scene);
  const Spring spring = spring_of(*effect, scene, mobility1 + mobility2, speed);
  const double steps = std::numbers::pi / (scene.time.step * std::sqrt(spring.stiffness * (mobility1 + mobility2)));
  if (!(steps < fx::kLeastContactSteps)) return {};
  const double shorter = steps / fx::kLeastContactSteps;
  const double softer = std::pow(shorter, 2 / spring.exponent);
  return {spring.section + " has contacts of fewer than ten steps: a shorter step would be better; " + name1 + " and " + name2 +
          " may touch for " + rounded(steps) + " steps, and time.step up to " + rounded(scene.time.step * shorter) +
          " s would do; " + spring.section + '.' + spring.key + " up to " + rounded(spring.value * softer) + ' ' + spring.unit +
          " would do too, but " + overlaps_of(spring, softer, speed, scene)};
}

}  // namespace falling_particles
