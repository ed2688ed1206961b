// The check of the free walls of a scene at the start.

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/input_error.hpp"
#include "base/interval.hpp"
#include "doubts.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

/// The deepest overlap of walls at the start, relative to the size of the free one: the rounding of a mesh, whose vertices are
/// single precision.
constexpr double kTouching = 1e-6;

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
    for (std::size_t k = 0; k < geoms.size(); ++k) {
      const double depth = k == i ? 0 : deepest_between(geoms[i], geoms[k]);
      if (depth <= kTouching * bounding_radius(wall.shape)) continue;
      throw InputError(scene.path + ": part \"" + wall.name + "\", which is free, is " + rounded(depth) + " m deep in " +
                       (scene.walls[k].is_part() ? "part \"" : "wall \"") + scene.walls[k].name +
                       "\" at the start; allowed: a start apart from all other walls");
    }
  }
}

}  // namespace falling_particles
