// The proved interval around the result after each evaluation.
#pragma once

#include "drawing/svg.hpp"
#include "method/explanation.hpp"

namespace explain_pair {

/// Draws the bounds of the hybrid solver relative to the result, and the values reached by the other solvers, against the number of
/// evaluations. Distances are on logarithmic axes, up and down from the result.
void draw_bounds(Svg& svg, const Box& box, const Explanation& explanation);

}  // namespace explain_pair
