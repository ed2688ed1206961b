// What a method of the literature did with a pair.
#pragma once

#include <vector>

#include "method/solver_path.hpp"

namespace explain_pair {

/// Runs every method of samples/benchmarks/literature at the tolerance of the settings: none if a body is neither a superellipsoid
/// nor an ellipsoid. A path has the normals of the iterates, with s there; evaluations for the start are counted only.
std::vector<SolverPath> literature_paths(const Pair& pair, const supernormal::Settings& settings);

}  // namespace explain_pair
