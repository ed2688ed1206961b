// The paths of literature methods for a pair.
#pragma once

#include <vector>

#include "method/solver_path.hpp"

namespace explain_pair {

/// Runs every method of samples/benchmarks/literature with the tolerance of the settings. Empty unless both bodies are
/// superellipsoids or ellipsoids. A path has the normals of the iterates with s(n). The evaluations of the start are only counted.
std::vector<SolverPath> literature_paths(const Pair& pair, const supernormal::Settings& settings);

}  // namespace explain_pair
