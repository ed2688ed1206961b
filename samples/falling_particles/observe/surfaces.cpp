#include "surfaces.hpp"

#include <algorithm>
#include <stdexcept>
#include <variant>

namespace falling_particles {
namespace {

constexpr const char* kLid = "lid";

/// Names the surfaces in the order in which ContainerGeoms creates their geoms.
struct Names {
  std::vector<std::string> operator()(const Box&) const { return {"floor", "x_low", "x_high", "y_low", "y_high"}; }
  std::vector<std::string> operator()(const Hopper& hopper) const {
    std::vector<std::string> names = {"floor", "x_low", "x_high", "y_low", "y_high", kLid, "hopper"};
    if (hopper.dish) names.emplace_back("dish");
    return names;
  }
  std::vector<std::string> operator()(const Terrain&) const { return {"x_low", "x_high", "y_low", "y_high", "ground"}; }
  template <typename WithoutWalls>
  std::vector<std::string> operator()(const WithoutWalls&) const {
    return {};
  }
};

}  // namespace

std::vector<std::string> surface_names(const Scene& scene) {
  std::vector<std::string> names = std::visit(Names{}, scene.container);
  for (std::size_t axis : {0U, 1U}) {  // a box has no walls across periodic axes
    if (!scene.periodic[axis]) continue;
    std::erase_if(names, [axis](const std::string& name) { return name.starts_with(axis == 0 ? "x_" : "y_"); });
  }
  for (const Wall& wall : scene.walls) names.push_back(wall.name);
  return names;
}

std::vector<NamedSurface> surfaces_of(const World& world, std::vector<std::string> names) {
  const bool is_open = std::holds_alternative<Hopper>(world.scene().container) && !world.container_geoms().has_lid();
  if (is_open) names.erase(std::ranges::find(names, kLid));
  std::vector<dGeomID> geoms = world.container_geoms().geoms();
  if (world.walls() != nullptr) geoms.insert(geoms.end(), world.walls()->geoms().begin(), world.walls()->geoms().end());
  if (names.size() != geoms.size()) throw std::logic_error("a scene has other walls than surfaces_of() names");
  std::vector<NamedSurface> surfaces;
  surfaces.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) surfaces.push_back({names[i], geoms[i]});
  return surfaces;
}

std::string surface_name(const std::vector<NamedSurface>& surfaces, dGeomID geom) {
  const auto found = std::ranges::find(surfaces, geom, &NamedSurface::geom);
  return found == surfaces.end() ? "wall" : found->name;
}

}  // namespace falling_particles
