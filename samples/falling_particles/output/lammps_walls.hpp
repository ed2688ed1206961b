// The walls of a container as commands of LAMMPS with fix wall/supernormal (samples/lammps).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

/// A file that a command reads.
struct LammpsFile {
  std::string name;
  std::string text;
};

/// A change of the walls during a run.
struct LammpsChange {
  double time;           ///< s
  std::string commands;  ///< between two runs
};

constexpr const char* kGravityFix = "fall";  ///< the name of fix gravity

struct LammpsWalls {
  std::array<std::array<double, 2>, 3> bounds;  ///< m; along x, y, z: of the space between the walls, open upwards
  const char* boundary = "f f m";               ///< of LAMMPS' box; shrink-wrapped around grains whose walls move
  std::string commands;
  std::optional<LammpsChange> change = {};  ///< the outlet of a hopper opens
  std::vector<LammpsFile> files = {};       ///< meshes, as OBJ
};

/// `laws`: the contact laws of the scene's walls, in the words of the fix. Throws InputError, which names the container, unless it
/// is a box, a cell, a drum or a hopper.
LammpsWalls lammps_walls(const Scene& scene, const std::vector<std::string>& laws);

}  // namespace falling_particles
