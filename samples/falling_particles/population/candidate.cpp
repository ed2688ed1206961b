#include "population/candidate.hpp"

#include <algorithm>

namespace falling_particles {

Candidate::Candidate(const Grain& grain, double scale)
    : world_(dWorldCreate()), body_{dBodyCreate(world_), nullptr, &grain, {}, scale} {
  body_.geom = attach_geoms(nullptr, grain, scale, body_.body, nullptr);
  body_.mass = mass_of(body_);
  geoms_ = body_.geoms();
}

Candidate::~Candidate() {
  std::ranges::for_each(geoms_, dGeomDestroy);
  dWorldDestroy(world_);
}

void Candidate::put(const Placement& place) const {
  const auto& [x, y, z] = place.position;
  const auto& [qw, qx, qy, qz] = place.quaternion;
  const dQuaternion q = {qw, qx, qy, qz};
  dBodySetPosition(body_.body, x, y, z);
  dBodySetQuaternion(body_.body, q);
}

}  // namespace falling_particles
