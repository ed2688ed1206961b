// The curvature of the gap function for shapes without a Hessian.
#pragma once

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

 private:
  Matrix3 H_ = Matrix3::Identity();
  double rounding_ = 0;  // m; of a boundary point
};

}  // namespace supernormal
