// A grain that looks for its place.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <vector>

#include "placement.hpp"
#include "world.hpp"

namespace falling_particles {

/// A grain outside the world of the others, which does not notice it.
class Candidate {
 public:
  /// `scale`: of the grain's lengths. The grain must outlive this object. Throws std::runtime_error when the library refuses it.
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
