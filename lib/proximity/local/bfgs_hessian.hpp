// The curvature of the gap function where the shapes have no Hessian.
#pragma once

#include <algorithm>
#include <limits>

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// A positive semi-definite estimate of H1 + H2 from the gradients met on the way (BFGS). The boundary points of a convex body
/// are a monotone function of the normal, so every update keeps it definite; the paper's fixed point (Algorithm II) estimates the
/// same radii of curvature, in one direction.
class BfgsHessian {
 public:
  /// Starts with the curvature of two spheres that have the support of the bodies at this normal, as Algorithm II does.
  void restart(const GapJet& jet);

  /// Learns from two evaluations.
  void update(const GapJet& from, const GapJet& to);

  const Matrix3& matrix() const { return H_; }

  /// The turn (about radians) over which both ways of the tangent plane were seen last: what is nearer may be different. Infinite
  /// before there were updates across one another, or any.
  double reach() const { return std::max(reach_along_, reach_across_); }

 private:
  Matrix3 H_ = Matrix3::Identity();
  double rounding_ = 0;             // m; of a boundary point
  Vector3 axis_ = Vector3::Zero();  // unit; of the turn of the last update
  double reach_along_ = std::numeric_limits<double>::infinity();
  double reach_across_ = std::numeric_limits<double>::infinity();
};

}  // namespace supernormal
