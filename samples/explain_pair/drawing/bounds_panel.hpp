// The proved interval around the answer after each evaluation.
#pragma once

#include "drawing/svg.hpp"
#include "method/explanation.hpp"

namespace explain_pair {

/// Draws how far the bounds of the hybrid are above and below the answer, and the values that the other solvers have reached, over
/// the number of evaluations; lengths on logarithmic axes up and down from the answer.
void draw_bounds(Svg& svg, const Box& box, const Explanation& explanation);

}  // namespace explain_pair
