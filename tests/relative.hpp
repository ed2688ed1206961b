// Comparison of numbers by their relative difference.
#pragma once

#include <doctest/doctest.h>

namespace supernormal::test {

/// Equal to `expected` within .epsilon(e) times the larger of the two. doctest's own Approx adds 1 to that: of a millimetre, in
/// metres, it would check nothing. Nothing but 0 itself is near 0.
inline doctest::Approx relative(double expected) { return doctest::Approx(expected).scale(0); }

}  // namespace supernormal::test
