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

/// What a run changes of the walls while it goes.
struct LammpsChange {
  double time;           ///< s
  std::string commands;  ///< between two runs
};

struct LammpsWalls {
  std::array<std::array<double, 2>, 3> bounds;  ///< m; along x, y, z: of the space that the walls leave to grains, open upwards
  std::string commands;
  std::optional<LammpsChange> change = {};  ///< the outlet of a hopper opens
  std::vector<LammpsFile> files = {};       ///< meshes, as OBJ
};

/// `law`: of all walls, in the words of the fix. Throws InputError, which names the container, when it has no counterpart: boxes,
/// drums and hoppers have.
LammpsWalls lammps_walls(const Scene& scene, const std::string& law);

}  // namespace falling_particles
