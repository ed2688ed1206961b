// The checks of the soak.
#pragma once

#include <cstdint>

#include "invariants.hpp"
#include "sample.hpp"

namespace supernormal::soak {

/// The findings about one sample.
struct Finding {
  samples::Violations violations;
  std::uint64_t queries = 0;      ///< calls of find_proximity
  std::uint64_t evaluations = 0;  ///< evaluations of the gap function in the queries that are counted one by one
  int most_evaluations = 0;       ///< evaluations of one query
  double error = 0;               ///< the largest error, in units of the smaller body's largest half-extent
  double error_of_bound = 0;      ///< the same in units of the answers' own bound, including rounding; above 1 it is a violation
  bool is_global = true;          ///< whether all answers claim to be global
  bool is_converged = true;       ///< whether all have converged
};

/// The allowed cost of the checks.
enum class Care {
  Usual,          ///< the expensive checks for some samples only
  Neighbourhood,  ///< the neighbourhood of every answer is searched for a higher normal
  All,
};

/// Queries the sample in several ways: from a cold start, with the bodies swapped, from a first normal, for separation only. Some
/// samples get all queries of the catalogue. Checks that:
///
/// * every answer is valid on its own (samples::check_answer),
/// * none of a few directions separates better than the answer allows,
/// * answers agree with one another and with the placed gap,
/// * no query raises a floating-point exception.
Finding examine(const Sample& sample, Random random, Care care = Care::Usual);

}  // namespace supernormal::soak
