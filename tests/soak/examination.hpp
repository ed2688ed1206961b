// What the soak program makes sure of.
#pragma once

#include <cstdint>

#include "invariants.hpp"
#include "sample.hpp"

namespace supernormal::soak {

/// What has been found out about one sample.
struct Finding {
  samples::Violations violations;
  std::uint64_t queries = 0;      ///< calls of find_proximity
  std::uint64_t evaluations = 0;  ///< of the gap function in those that are counted one by one
  int most_evaluations = 0;       ///< of one query
  double error = 0;               ///< the largest that was seen, in units of the smaller body's largest half-extent
  double error_of_bound = 0;      ///< the same in units of what the answers promise, rounding included; above 1 it is a violation
  bool is_global = true;          ///< all answers claim to be
  bool is_converged = true;       ///< all
};

/// How dear the checks may be.
enum class Care {
  Usual,          ///< the dear ones of some samples only
  Neighbourhood,  ///< every answer's is searched for a higher normal
  All,
};

/// Asks the sample in several ways: cold, with the bodies swapped, from a first normal, for separation only; some samples in all
/// the ways that the catalogue knows. Sees to it that every answer is sound in itself (samples::check_answer), that no direction of
/// a handful separates better than the answer says is possible, that answers agree with one another and with the placed gap, and
/// that no query raises a floating-point exception.
Finding examine(const Sample& sample, Random random, Care care = Care::Usual);

}  // namespace supernormal::soak
