// Catalogues of grains.
#pragma once

#include <string>
#include <vector>

#include "grain.hpp"

namespace falling_particles {

/// Loads the grains of a catalogue file, one table a grain, in the order of the file. Throws InputError.
std::vector<Grain> load_catalogue(const std::string& path);

}  // namespace falling_particles
