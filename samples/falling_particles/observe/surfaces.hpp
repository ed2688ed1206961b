// The names of the surfaces that grains meet besides other grains.
#pragma once

#include <ode/ode.h>

#include <string>
#include <vector>

#include "base/toml_input.hpp"
#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// A geom of a wall and its name in scene files and tables. Several geoms may have the same name.
struct NamedSurface {
  std::string name;
  dGeomID geom;
};

/// The names of all walls of a scene ("floor", "x_low", "x_high", "y_low", "y_high" of a box or a hopper's tray, "lid", "hopper",
/// "dish", "ground"; names of parts).
std::vector<std::string> surface_names(const Scene& scene);

/// The names under `surfaces` of a measurement, or all names. Throws InputError.
std::vector<std::string> read_surfaces(const TomlTable& table, const Scene& scene);

/// The walls of a world, without a lid that it has removed.
std::vector<NamedSurface> surfaces_of(const World& world);

/// The name of a geom's surface; "wall" if it has none.
std::string surface_name(const std::vector<NamedSurface>& surfaces, dGeomID geom);

}  // namespace falling_particles
