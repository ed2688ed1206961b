// The settings of the contact queries of a scene.
#pragma once

#include <supernormal/supernormal.h>

#include <optional>
#include <string>

#include "base/toml_input.hpp"

namespace falling_particles {

/// The settings of all queries of two smooth bodies (snSetDefaultSolver, snSetWarmStart). Without a section [query] the library's
/// defaults hold.
struct Query {
  snSolver solver = SN_SOLVER_HYBRID;
  double tolerance = 1e-9;  ///< of the gap, relative to the smallest half-extent
  int max_evaluations = 1000;
  bool warm_start = true;  ///< whether a query starts from the last normal of its pair
};

std::string name_of(snSolver solver);

/// Reads the section [query], if there is one. Throws InputError.
std::optional<Query> load_query(const TomlTable& root);

}  // namespace falling_particles
