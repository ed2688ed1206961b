// Catalogues of grains.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/grain_kind.hpp"

namespace falling_particles {

/// A grain of a catalogue, read and checked. The mass of a compound takes tenths of a second, so it is integrated when the grain
/// is made.
struct CatalogueEntry {
  std::string name;
  std::function<GrainKind()> make;
};

/// Reads a catalogue file, one table a grain, in the order of the file. Throws InputError.
std::vector<CatalogueEntry> open_catalogue(const std::string& path);

/// Makes all grains of a catalogue file, in its order. Throws InputError.
std::vector<GrainKind> load_catalogue(const std::string& path);

}  // namespace falling_particles
