// A search for places where a grain touches nothing.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "model/geometry.hpp"
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

/// The geoms in a region of a world at one time.
class Neighbourhood {
 public:
  /// Contains the grains, their images in a periodic world, and the walls whose bounding boxes meet the region.
  Neighbourhood(const World& world, const Region& region);

  void add(dGeomID geom) { geoms_.push_back(geom); }
  /// Whether `geom`, of the library's class, overlaps none of them, to the tolerance of snGeomProximity. A wall that is a surface,
  /// a mesh or a terrain, overlaps no grain behind it. Throws std::runtime_error.
  bool is_free(dGeomID geom) const;

 private:
  std::vector<dGeomID> geoms_;
};

/// A random position and orientation such that a ball of `radius` (m) lies within the region.
Placement random_place(const Region& region, std::size_t kind, double scale, double radius, Random& random);

}  // namespace falling_particles
