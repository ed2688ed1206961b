#include "body_energy.hpp"

namespace falling_particles {

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

}  // namespace falling_particles
