// The curvature of the gap function for shapes without a Hessian.
#pragma once

#include <algorithm>
#include <limits>

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A positive semi-definite estimate of H1 + H2 from successive gradients (BFGS). The boundary points of a convex body are a
/// monotone function of the normal, so every update keeps the estimate definite. The paper's fixed point (Algorithm II) estimates
/// the same radii of curvature, in one direction.
class BfgsHessian {
 public:
  /// Starts with the curvature of two spheres whose support equals the support of the bodies at this normal, as Algorithm II does.
  void restart(const GapJet& jet);

  /// Updates the estimate with two evaluations.
  void update(const GapJet& from, const GapJet& to);

  const Matrix3& matrix() const { return H_; }

  /// The angle (about rad) of the last updates in both directions of the tangent plane; the curvature within it may differ.
  /// Infinite before there were updates in two directions.
  double reach() const { return std::max(reach_along_, reach_across_); }

 private:
  Matrix3 H_ = Matrix3::Identity();
  double rounding_ = 0;             // m; of a boundary point
  Vector3 axis_ = Vector3::Zero();  // unit; axis of the last update's rotation
  double reach_along_ = std::numeric_limits<double>::infinity();
  double reach_across_ = std::numeric_limits<double>::infinity();
};

}  // namespace supernormal
