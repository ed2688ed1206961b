// The gap function near one normal.
#pragma once

#include "proximity/local/trust_region.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The quadratic model of s in a tangent plane. It contains each body's part in the body's own frame.
///
/// The radius of curvature of a face or along a straight edge is infinite, to rounding. In a basis that is not aligned with it,
/// rounding would spread the infinite value over the whole matrix, and nothing would be left of the other radius. So the basis is
/// aligned with the flattest axis of the flatter body, in its frame, and each Hessian is projected in its own frame.
struct LocalModel {
  TangentPlane plane1;   ///< in body 1's frame, normal n
  TangentPlane plane2;   ///< the same plane in body 2's frame; its normal is R^T n = -m
  Symmetric2 A1, A2;     ///< m; H1 and H2 in the plane
  QuadraticModel model;  ///< of s

  /// `jet` must contain the Hessians of both bodies.
  static LocalModel of(const GapFunction& gap, const GapJet& jet);

  /// With an estimate `H` of H1 + H2 (body 1's frame) for bodies without a Hessian. A1 and A2 are then half of it each.
  static LocalModel of(const GapFunction& gap, const GapJet& jet, const Matrix3& H);
};

}  // namespace supernormal
