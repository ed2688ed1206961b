// The gap function near one normal.
#pragma once

#include "proximity/local/trust_region.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The quadratic model of s in a tangent plane, with the part of each body in its own frame.
///
/// A face or an edge has a radius of curvature that is infinite but for rounding. In a basis that is not aligned with it, rounding
/// would spread that infinity over the whole matrix and leave nothing of the other radius. So the basis is built in the frame of
/// the flatter body, along its flattest axis, and each Hessian is projected in its own frame.
struct LocalModel {
  TangentPlane plane1;   ///< in body 1's frame, normal n
  TangentPlane plane2;   ///< the same plane in body 2's frame (its normal is R^T n = -m)
  Symmetric2 A1, A2;     ///< m; H1 and H2 in the plane
  QuadraticModel model;  ///< of s

  /// `jet` needs curvature of both bodies.
  static LocalModel of(const GapFunction& gap, const GapJet& jet);

  /// With an estimate of H1 + H2 (body 1's frame) for bodies that have no Hessian; A1 and A2 are then half of it each.
  static LocalModel of(const GapFunction& gap, const GapJet& jet, const Matrix3& H);
};

}  // namespace supernormal
