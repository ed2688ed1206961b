// The check of the free walls of a scene at the start.

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <vector>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "refusals.hpp"

namespace falling_particles {
namespace {

/// m, the deepest overlap of a free wall with other walls at the start. Beside a state it is the one of grains, or of a thin wall.
double allowed_depth(const Wall& wall, const Scene& scene) {
  constexpr double kTouching = 1e-6;  // of the wall's size: the rounding of a mesh, whose vertices are single precision
  const double touching = kTouching * bounding_radius(wall.shape);
  if (!scene.start) return touching;
  return std::max(touching, scene.start->overlap * std::min(scene.smallest_half_axis(), thinnest(wall.shape) / 2));
}

double deepest_between(dGeomID g1, dGeomID g2) {
  constexpr int kMost = 64;
  std::array<dContactGeom, kMost> found;
  const int count = dCollide(g1, g2, kMost, found.data(), sizeof(dContactGeom));
  double deepest = 0;
  for (int i = 0; i < count; ++i) deepest = std::max<double>(deepest, found[static_cast<std::size_t>(i)].depth);
  return deepest;
}

}  // namespace

void refuse_bad_flights(const World& world) {
  const Scene& scene = world.scene();
  const std::vector<dGeomID>& geoms = world.walls().geoms();
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    const Wall& wall = scene.walls[i];
    if (!wall.flight) continue;
    const double allowed = allowed_depth(wall, scene);
    for (std::size_t k = 0; k < geoms.size(); ++k) {
      const double depth = k == i ? 0 : deepest_between(geoms[i], geoms[k]);
      if (depth <= allowed) continue;
      throw InputError(scene.called + ": part \"" + wall.name + "\", which is free, is " + rounded(depth) + " m deep in " +
                       scene.walls[k].called() + " at the start; allowed: " +
                       (scene.start ? "up to " + rounded(allowed) + " m, from start.overlap of the smallest half-axis"
                                    : "a start apart from all other walls, or a section [start], whose start.overlap allows more"));
    }
  }
}

}  // namespace falling_particles
