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
