// Places in a world where a grain touches nothing.
#pragma once

#include <ode/ode.h>

#include <vector>

#include "container/open.hpp"
#include "simulation/world.hpp"

namespace falling_particles {

/// What is in a region of a world, at one moment.
class Neighbourhood {
 public:
  /// Grains, their images in a periodic world, walls and parts whose bounding boxes meet the region.
  Neighbourhood(const World& world, const Region& region);

  void add(dGeomID geom) { geoms_.push_back(geom); }
  /// Whether the geom, one of ours, overlaps none of them, to the tolerance of snGeomProximity. A grain behind a wall that is a
  /// sheet, a mesh or a terrain, counts as free. Throws std::runtime_error.
  bool is_free(dGeomID geom) const;

 private:
  std::vector<dGeomID> geoms_;
};

}  // namespace falling_particles
