#include "surfaces.hpp"

#include <algorithm>

#include "common/nearest_word.hpp"

namespace falling_particles {

std::vector<std::string> surface_names(const Scene& scene) {
  std::vector<std::string> names;
  names.reserve(scene.walls.size());
  for (const Wall& wall : scene.walls) names.push_back(wall.name);
  return names;
}

std::vector<std::string> read_surfaces(const TomlTable& table, const Scene& scene) {
  const std::vector<std::string> names = surface_names(scene);
  if (names.empty()) {
    table.fail("surfaces", table.text("kind") + " in a " + kind_of(scene.container) + "; allowed: where there is a wall");
  }
  std::vector<std::string> chosen = table.has("surfaces") ? table.choices("surfaces", names) : names;
  if (chosen.empty()) table.fail("surfaces", table.full_name("surfaces") + " is empty; allowed: words of " + join(names));
  return chosen;
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
