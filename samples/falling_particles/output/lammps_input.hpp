// A scene as an input of LAMMPS with pair_style supernormal (samples/lammps).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lammps_walls.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// The files of an input.
struct LammpsInput {
  std::string commands;                ///< NAME.in
  std::string data;                    ///< NAME.data: the grains, where the run of this seed starts them
  std::vector<LammpsFile> files = {};  ///< of walls that are meshes
};

/// The scene with contacts that are springs: its own of [hertz] or [compliance], or springs so stiff that the fastest grain sinks
/// in by a hundredth of the smallest half-axis; and a step of a fiftieth of the shortest impact. The commands begin with what
/// differs. A scene with what has no counterpart is refused by InputError: containers but box, drum and hopper, parts that are
/// driven or solid, forces in a fluid, materials.
LammpsInput lammps_input(const Scene& scene);

/// Writes FOLDER/NAME.in, FOLDER/NAME.data and the meshes.
void write_lammps_input(const Scene& scene, const std::filesystem::path& folder);

}  // namespace falling_particles
