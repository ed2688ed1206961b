#include "grain_energy.hpp"

namespace falling_particles {

double kinetic_energy(const Grain& grain) {
  const dReal* v = dBodyGetLinearVel(grain.body);
  const dReal* w = dBodyGetAngularVel(grain.body);
  dVector3 spin;  // in the grain's frame, where the inertia is constant
  dBodyVectorFromWorld(grain.body, w[0], w[1], w[2], spin);
  double twice_rotation = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) twice_rotation += spin[i] * grain.mass.I[4 * i + j] * spin[j];
  }
  return 0.5 * (grain.mass.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + twice_rotation);
}

double energy_of(const Grain& grain, const Scene& scene) {
  double energy = kinetic_energy(grain);
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr) return energy;
  const Point position = grain.position();
  for (std::size_t i = 0; i < 3; ++i) {
    energy -= grain.mass.mass * gravity->acceleration[static_cast<Eigen::Index>(i)] * position[i];
  }
  return energy;
}

}  // namespace falling_particles
