// The names of the surfaces that grains meet besides one another.
#pragma once

#include <ode/ode.h>

#include <string>
#include <vector>

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// A wall as a scene file and a table call it. Several geoms may have one name.
struct NamedSurface {
  std::string name;
  dGeomID geom;
};

/// The names that a container has, "floor", "x_low", "x_high", "y_low", "y_high" of a box or a hopper's tray, "lid", "hopper",
/// "dish", "ground", and those of the scene's parts.
std::vector<std::string> surface_names(const Scene& scene);

/// The surfaces of a world. `names`: surface_names() of its scene.
std::vector<NamedSurface> surfaces_of(const World& world, std::vector<std::string> names);

/// The name of a geom's surface, "wall" if it has none.
std::string surface_name(const std::vector<NamedSurface>& surfaces, dGeomID geom);

}  // namespace falling_particles
