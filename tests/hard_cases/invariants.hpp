// Conditions that every answer has to satisfy, known without another answer to compare it with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalogue.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal::samples {

/// Violated conditions, one sentence each with the numbers; empty when all is well.
using Violations = std::vector<std::string>;

/// The answer to a case. Floating-point exceptions that the query raised (invalid, division by zero, overflow) are violations.
Proximity solve(const HardCase& one, const Settings& settings, Violations& violations);

/// How much rounding of the input and of the answer's coordinates may change lengths along the normal, m.
double rounding_of(const HardCase& one);

/// The allowed error of the gap of an answer that claims to be global, m: Proximity::is_global.
double error_of(const HardCase& one, const Settings& settings, const Proximity& answer);

/// Checks the answer alone: every number is finite, the normal is of unit length, the status is one that the hybrid may end with
/// and fits the error, the gap is that of the normal, both witness points are on their surfaces and `gap` apart along the normal,
/// and the contact point is between them. Costs about ten evaluations.
Violations check_answer(const HardCase& one, const Settings& settings, const Proximity& answer);

/// Checks that no normal is higher: none in the neighbourhood, walking uphill only; and none of the bodies' axes, sharp features
/// and of some random directions drawn with `seed`, if the answer claims to be global. Costs some hundred evaluations.
Violations check_maximum(const HardCase& one, const Settings& settings, const Proximity& answer, std::uint64_t seed = 1);

/// Checks that repeating the query, swapping the bodies, moving the frame, changing the unit of length (by powers of two: every
/// digit), starting elsewhere and stopping early change nothing but rounding. Costs some ten queries.
Violations check_invariance(const HardCase& one, const Settings& settings, const Proximity& answer);

/// Does all of these checks.
Violations check(const HardCase& one, const Settings& settings = {});

}  // namespace supernormal::samples
