// A search for places where a grain touches nothing.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "model/open.hpp"
#include "world.hpp"

namespace falling_particles {

/// The geoms in a region of a world at one time.
class Neighbourhood {
 public:
  /// Contains the grains, their images in a periodic world, and the walls whose bounding boxes meet the region.
  Neighbourhood(const World& world, const Region& region);

  void add(dGeomID geom) { geoms_.push_back(geom); }
  /// A geom that `geom`, of the library's class, overlaps to the tolerance of snGeomProximity; null if there is none. A wall that
  /// is a surface, a mesh or a terrain, overlaps no grain behind it. Throws std::runtime_error.
  dGeomID find_overlap(dGeomID geom) const;
  bool is_free(dGeomID geom) const { return find_overlap(geom) == nullptr; }

 private:
  std::vector<dGeomID> geoms_;
};

/// A random position and orientation such that a ball of `radius` (m) lies within the region.
Placement random_place(const Region& region, std::size_t kind, double scale, double radius, Random& random);

}  // namespace falling_particles
