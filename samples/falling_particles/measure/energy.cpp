#include "energy.hpp"

#include <algorithm>

namespace falling_particles {
namespace {

double kinetic_energy(const Body& body) {
  const dReal* v = dBodyGetLinearVel(body.body);
  const dReal* w = dBodyGetAngularVel(body.body);
  dVector3 spin;  // in the body's frame, where the inertia is constant
  dBodyVectorFromWorld(body.body, w[0], w[1], w[2], spin);
  double twice_rotation = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) twice_rotation += spin[i] * body.mass.I[4 * i + j] * spin[j];
  }
  return 0.5 * (body.mass.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + twice_rotation);
}

}  // namespace

double energy_of(const Body& body, const Scene& scene) {
  double energy = kinetic_energy(body);
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr) return energy;
  const Point position = body.position();
  for (std::size_t i = 0; i < 3; ++i) {
    energy -= body.mass.mass * gravity->acceleration[static_cast<Eigen::Index>(i)] * position[i];
  }
  return energy;
}

Energy measure_energy(const World& world, const Scene& scene) {
  Energy energy{0, 0};
  const auto* const gravity = scene.gravity();
  for (const Body& body : world.present()) {
    energy.kinetic += kinetic_energy(body);
    if (gravity == nullptr) continue;
    const dReal* position = dBodyGetPosition(body.body);
    for (int i = 0; i < 3; ++i) energy.potential -= body.mass.mass * gravity->acceleration[i] * position[i];
  }
  return energy;
}

double kinetic_height(const World& world, const Scene& scene) {
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr) return 0;
  double mass = 0;
  for (const Body& body : world.present()) mass += body.mass.mass;
  const double weight = mass * gravity->acceleration.norm();
  return weight > 0 ? measure_energy(world, scene).kinetic / weight : 0;
}

double largest_kinetic_energy(const World& world) {
  double largest = 0;
  for (const Body& body : world.present()) largest = std::max(largest, kinetic_energy(body));
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
