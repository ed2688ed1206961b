// The checks of the soak.
#pragma once

#include <vector>

#include "invariants.hpp"
#include "sample.hpp"

namespace supernormal::soak {

/// The findings about one sample.
struct Finding {
  samples::Violations violations;
  Proximity answer;                    ///< from a cold start, or from the sample's normal
  std::vector<Proximity> other_forms;  ///< with the bodies swapped, from a warm start, and for separation only
};

/// The allowed cost of the checks.
enum class Care {
  Usual,          ///< the expensive checks for some samples only
  Neighbourhood,  ///< the neighbourhood of every answer is searched for a higher normal
  All,
};

/// Asks the sample, then with the bodies swapped, from a normal near the answer's, and for separation only. Some samples get all
/// queries of the catalogue. Checks that:
///
/// * every answer is valid on its own (samples::check_answer), and raises no floating-point exception,
/// * none of a few directions separates better than the answer allows,
/// * answers agree with one another (samples::check_forms) and with the placed gap.
Finding examine(const Sample& sample, Random random, Care care = Care::Usual);

}  // namespace supernormal::soak
