// The points of a body with four normals, in lanes. Plain numbers: the files compiled for wide registers see no other type
// (real.hpp).
#pragma once

#include "supernormal/shapes/lane_body.hpp"

namespace supernormal {

/// Evaluates a body for four outward vectors of any length but 0, in its frame. Vectors are twelve numbers: four x, four y, four z.
/// `h`: the support function times the length of the vector, m. `points`: the boundary points, m.
using EvaluateFour = void(const LaneBody& body, const double* normals, double* h, double* points);

/// Both give the same digits.
EvaluateFour evaluate_in_two_lanes, evaluate_in_four_lanes;

/// The widest that this processor can run.
EvaluateFour* four_at_once();

}  // namespace supernormal
