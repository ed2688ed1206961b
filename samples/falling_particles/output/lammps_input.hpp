// A scene as an input of LAMMPS with pair_style supernormal (samples/lammps).
#pragma once

#include <array>
#include <filesystem>
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

/// The files of an input.
struct LammpsInput {
  std::string commands;                ///< NAME.in
  std::string data;                    ///< NAME.data: the grains at the start of a run with this seed
  std::vector<LammpsFile> files = {};  ///< of mesh walls
  std::vector<std::string> warnings = {};
};

/// Converts a scene to contacts with springs. These are the springs of [hertz] or [compliance], or stiff springs with which the
/// fastest grain sinks in by a hundredth of the smallest half-axis. A step is a fiftieth of the shortest impact. The commands begin
/// with a list of the differences. Throws InputError if the scene has anything without a counterpart: containers but box, cell,
/// drum and hopper, [[part]], [query], feeders, sinks, [periodic], compounds, capsules, forces in a fluid, materials.
LammpsInput lammps_input(const Scene& scene);

/// Writes FOLDER/NAME.in, FOLDER/NAME.data and the meshes. Returns warnings.
std::vector<std::string> write_lammps_input(const Scene& scene, const std::filesystem::path& folder);

}  // namespace falling_particles
