// Places in a world where a grain touches nothing.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "model/open.hpp"
#include "world.hpp"

namespace falling_particles {

/// What is in a region of a world, at one moment.
class Neighbourhood {
 public:
  /// Grains, their images in a periodic world, walls and parts whose bounding boxes meet the region.
  Neighbourhood(const World& world, const Region& region);

  void add(dGeomID geom) { geoms_.push_back(geom); }
  /// One of them that the geom, one of ours, overlaps, to the tolerance of snGeomProximity; null if there is none. A grain behind a
  /// wall that is a sheet, a mesh or a terrain, overlaps none. Throws std::runtime_error.
  dGeomID find_overlap(dGeomID geom) const;
  bool is_free(dGeomID geom) const { return find_overlap(geom) == nullptr; }

 private:
  std::vector<dGeomID> geoms_;
};

/// A random place and attitude at which a ball of `radius` (m) is within the region.
Placement random_place(const Region& region, std::size_t kind, double scale, double radius, Random& random);

}  // namespace falling_particles
