// The list of the tables of runs, for users and for programs that read them.
#pragma once

#include <string>

#include "model/scene.hpp"

namespace falling_particles {

/// The list for users, as text: the lines and columns of each table.
std::string list_tables();

/// The tables that a run of the scene writes, as TOML: "energies.csv" = ["time_s", …]. Nothing is run.
std::string tables_of(const Scene& scene);

}  // namespace falling_particles
