// Conditions that every answer has to satisfy, checked without another answer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "supernormal/proximity/proximity.hpp"
#include "support/hard_cases/catalogue.hpp"

namespace supernormal::samples {

/// The violations, one sentence each with the numbers; empty if there are none.
using Violations = std::vector<std::string>;

/// The answer to a case. Floating-point exceptions that the query raised (invalid, division by zero, overflow) are violations.
Proximity solve(const HardCase& one, const Settings& settings, Violations& violations);

/// The rounding of the input and of the answer's coordinates may change lengths along the normal by this much, m.
double rounding_of(const HardCase& one);

/// The error that the gap of an answer may have if it claims to be global, m: Proximity::is_global.
double error_of(const HardCase& one, const Settings& settings, const Proximity& answer);

/// The upper bound of the gap function by the answer, plus rounding, m: Proximity::global_error.
double ceiling_of(const HardCase& one, const Settings& settings, const Proximity& answer);

/// Checks the answer alone:
///
/// * every number is finite, the normal is a unit vector, and the status is possible for the hybrid and fits the error;
/// * the gap belongs to the normal, both witness points are on their surfaces and `gap` apart along the normal, with the contact
///   point between them;
/// * the answer is converged and global if the bodies are apart, touch, or overlap by less than the rolling radius.
///
/// Costs about ten evaluations.
Violations check_answer(const HardCase& one, const Settings& settings, const Proximity& answer);

/// Checks that no normal is higher than the answer allows. It tries rings around the answer's normal, the normals of the bodies'
/// axes and sharp features, and some random directions drawn with `seed`. Costs some hundred evaluations.
Violations check_maximum(const HardCase& one, const Settings& settings, const Proximity& answer, std::uint64_t seed = 1);

/// Checks that these change nothing but rounding: swapped bodies, the start `start` (unit, body 1's frame), and an early stop.
/// `answers` become theirs.
Violations check_forms(const HardCase& one, const Settings& settings, const Proximity& answer, const Vector3& start,
                       std::vector<Proximity>& answers);

/// Checks that these change nothing but rounding: a repeated query, swapped bodies, a moved frame, another unit of length (a power
/// of two: every digit), another start, and an early stop. Costs some ten queries.
Violations check_invariance(const HardCase& one, const Settings& settings, const Proximity& answer);

/// All of these checks.
Violations check(const HardCase& one, const Settings& settings = {});

/// lower <= signed gap <= upper, up to the rounding of the support functions; from a source other than the solvers.
struct Reference {
  double lower = 0;  ///< m
  double upper = 0;  ///< m

  /// The distance of a gap from the interval, m; 0 inside.
  double distance(double gap) const { return std::max({lower - gap, gap - upper, 0.}); }
};

/// Encloses the gap by branch and bound over all normals (tests/proximity/collider_reference), to 1e-12 of the smallest half-extent
/// or rounding. Stops after `max_evaluations` with a wider interval.
Reference enclose_gap(const HardCase& one, int max_evaluations = 1000000);

/// The case's own gap, if it has one; otherwise it is enclosed.
Reference find_reference(const HardCase& one);

}  // namespace supernormal::samples
