#include "candidate.hpp"

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

}  // namespace falling_particles
