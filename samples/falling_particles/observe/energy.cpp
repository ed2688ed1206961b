#include "energy.hpp"

#include <algorithm>

#include "world/grain.hpp"

namespace falling_particles {
Energy measure_energy(const World& world, const Scene& scene) {
  Energy energy{0, world.bonds() == nullptr ? 0 : world.bonds()->energy()};
  const auto* const gravity = scene.gravity();
  for (const Grain& grain : world.present()) {
    energy.kinetic += kinetic_energy(grain);
    if (gravity == nullptr) continue;
    const dReal* position = dBodyGetPosition(grain.body);
    for (int i = 0; i < 3; ++i) energy.potential -= grain.mass.mass * gravity->acceleration[i] * position[i];
  }
  return energy;
}

double kinetic_height(const World& world, const Scene& scene) {
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr) return 0;
  double mass = 0;
  for (const Grain& grain : world.present()) mass += grain.mass.mass;
  const double weight = mass * gravity->acceleration.norm();
  return weight > 0 ? measure_energy(world, scene).kinetic / weight : 0;
}

double largest_kinetic_energy(const World& world) {
  double largest = 0;
  for (const Grain& grain : world.present()) largest = std::max(largest, kinetic_energy(grain));
  return largest;
}

EnergyWatch::EnergyWatch(const World& world, const Scene& scene)
    : world_(world), scene_(scene), start_(measure_energy(world, scene).total()), least_(start_) {}

void EnergyWatch::exchange(double energy) {
  start_ += energy;
  least_ += energy;
}

void EnergyWatch::after_step() {
  const double now = measure_energy(world_, scene_).total();
  gained_ = std::max(gained_, now - least_);
  least_ = std::min(least_, now);
}

}  // namespace falling_particles
