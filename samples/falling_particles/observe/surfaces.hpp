// The names of the surfaces that grains meet besides other grains.
#pragma once

#include <ode/ode.h>

#include <string>
#include <vector>

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// A geom of a wall and its name in scene files and tables. Several geoms may have the same name.
struct NamedSurface {
  std::string name;
  dGeomID geom;
};

/// The names of the container's surfaces ("floor", "x_low", "x_high", "y_low", "y_high" of a box or a hopper's tray, "lid",
/// "hopper", "dish", "ground") and of the scene's walls.
std::vector<std::string> surface_names(const Scene& scene);

/// The surfaces of a world. `names`: surface_names() of its scene.
std::vector<NamedSurface> surfaces_of(const World& world, std::vector<std::string> names);

/// The name of a geom's surface; "wall" if it has none.
std::string surface_name(const std::vector<NamedSurface>& surfaces, dGeomID geom);

}  // namespace falling_particles
