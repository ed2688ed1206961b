#include "candidate.hpp"

#include <algorithm>

namespace falling_particles {

Candidate::Candidate(const GrainKind& kind, double scale)
    : world_(dWorldCreate()), grain_{dBodyCreate(world_), nullptr, &kind, {}, scale} {
  grain_.geom = attach_geoms(nullptr, kind, scale, grain_.body, nullptr);
  grain_.mass = mass_of(grain_);
  geoms_ = grain_.geoms();
}

Candidate::~Candidate() {
  std::ranges::for_each(geoms_, dGeomDestroy);
  dWorldDestroy(world_);
}

}  // namespace falling_particles
