#include "surfaces.hpp"

#include <algorithm>

namespace falling_particles {

std::vector<std::string> surface_names(const Scene& scene) {
  std::vector<std::string> names;
  names.reserve(scene.walls.size());
  for (const Wall& wall : scene.walls) names.push_back(wall.name);
  return names;
}

std::vector<NamedSurface> surfaces_of(const World& world) {
  std::vector<NamedSurface> surfaces;
  for (const dGeomID geom : world.walls().geoms()) {
    surfaces.push_back({world.walls().wall_of(geom)->name, geom});
  }
  return surfaces;
}

std::string surface_name(const std::vector<NamedSurface>& surfaces, dGeomID geom) {
  const auto found = std::ranges::find(surfaces, geom, &NamedSurface::geom);
  return found == surfaces.end() ? "wall" : found->name;
}

}  // namespace falling_particles
