// What every answer has to satisfy, known without another answer to compare it with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "supernormal/proximity/proximity.hpp"
#include "support/hard_cases/catalogue.hpp"

namespace supernormal::samples {

/// What is wrong, one sentence each with the numbers; empty when all is well.
using Violations = std::vector<std::string>;

/// The answer to a case. Floating-point exceptions that the query raised (invalid, division by zero, overflow) are violations.
Proximity solve(const HardCase& one, const Settings& settings, Violations& violations);

/// By how much rounding of the input and of the answer's coordinates may change lengths along the normal, m.
double rounding_of(const HardCase& one);

/// What the gap of an answer that claims to be global may be off by, m: Proximity::is_global.
double error_of(const HardCase& one, const Settings& settings, const Proximity& answer);

/// No value of the gap function is larger, as the answer says, but for rounding, m: Proximity::global_error.
double ceiling_of(const HardCase& one, const Settings& settings, const Proximity& answer);

/// The answer alone: every number finite, unit normal, a status that the hybrid may end with and that fits the error, the gap that
/// of the normal, both witness points on their surfaces and `gap` apart along the normal, the contact point between them; converged
/// and sure to be global if the bodies are apart, touch, or overlap by less than the ball that rolls inside them. Costs about ten
/// evaluations.
Violations check_answer(const HardCase& one, const Settings& settings, const Proximity& answer);

/// That no normal is higher than the answer says is possible: none on rings around its own, of the bodies' axes and sharp features,
/// and of some random directions drawn with `seed`. Costs some hundred evaluations.
Violations check_maximum(const HardCase& one, const Settings& settings, const Proximity& answer, std::uint64_t seed = 1);

/// That asking again, swapping the bodies, moving the frame, changing the unit of length (by powers of two: every digit), starting
/// elsewhere and stopping early change nothing but rounding. Costs some ten queries.
Violations check_invariance(const HardCase& one, const Settings& settings, const Proximity& answer);

/// All of them.
Violations check(const HardCase& one, const Settings& settings = {});

}  // namespace supernormal::samples
