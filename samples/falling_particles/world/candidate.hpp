// A grain to be placed.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <vector>

#include "placement.hpp"
#include "world.hpp"

namespace falling_particles {

/// A grain in a world of its own, so that other grains do not collide with it.
class Candidate {
 public:
  /// `scale`: factor on the lengths of the kind, which must outlive this object. Throws std::runtime_error when the library refuses
  /// the grain.
  Candidate(const GrainKind& kind, double scale);
  ~Candidate();
  Candidate(const Candidate&) = delete;
  Candidate& operator=(const Candidate&) = delete;

  const Grain& grain() const { return grain_; }
  const std::vector<dGeomID>& geoms() const { return geoms_; }
  void put(const Placement& place) const { falling_particles::put(grain_.body, place); }

 private:
  dWorldID world_;
  Grain grain_;
  std::vector<dGeomID> geoms_;
};

}  // namespace falling_particles
