// The extent of a body along a direction, from its implicit function.
#pragma once

#include "superquadric.hpp"

namespace literature {

struct Extent {
  bool has_converged = false;
  double reach = 0;  ///< m; from the centre to the supporting plane
  int evaluations = 0;
};

/// The largest n.x with F(x) = 0, by Newton's method for x and a multiplier, with a line search. It starts at the point of the
/// ellipsoid with the same half-axes or, for exponents above 2, at the vertex of the box. It ends with a step of `tolerance` times
/// the smallest half-axis. `direction`: unit, in the body's frame.
Extent extent_by_newton(const Superquadric& body, const Vector3& direction, double tolerance);

}  // namespace literature
