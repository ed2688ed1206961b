// Catalogues of grains.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/grain_kind.hpp"

namespace falling_particles {

/// An entry of a catalogue, read and checked. make() integrates the mass of a compound, which takes tenths of a second.
struct CatalogueEntry {
  std::string name;
  std::function<GrainKind()> make;
};

/// Reads a catalogue file, with a table for each kind, in the order of the file. Throws InputError.
std::vector<CatalogueEntry> open_catalogue(const std::string& path);

}  // namespace falling_particles
