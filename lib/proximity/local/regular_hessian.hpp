// Newton's step on the unit sphere without a basis of the tangent plane.
#pragma once

#include <cmath>

#include "proximity/gap/limits.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// M = H + s I + t n n^T, where t is the trace of H + |s| I. Because H n = 0, M maps n to a multiple of n, and vectors across n to
/// vectors across n. There M is the negative Hessian of the gap function. So one factorization L D L^T in three dimensions solves
/// for steps in the tangent plane.
class RegularHessian {
 public:
  /// H and s in m. The result is regular if M is positive definite beyond rounding, and if its trace, in units of `length_unit`
  /// (m), is neither zero nor larger than `flattest`.
  RegularHessian(const Matrix3& H, double s, const Vector3& n, double length_unit, double flattest) {
    const double trace = H.trace() + std::abs(s);
    if (!(trace < flattest * length_unit && trace > limits::kNothing * length_unit)) return;
    const Vector3 lift = trace * n;
    const double least = limits::kSingularHessian * trace;
    const double xx = H(0, 0) + s + lift.x() * n.x();
    if (!(xx > least)) return;
    const double xy = H(1, 0) + lift.y() * n.x(), xz = H(2, 0) + lift.z() * n.x();
    inverse_.x() = 1 / xx;
    yx_ = xy * inverse_.x();
    zx_ = xz * inverse_.x();
    const double yy = H(1, 1) + s + lift.y() * n.y() - yx_ * xy;
    if (!(yy > least)) return;
    const double yz = H(2, 1) + lift.z() * n.y() - zx_ * xy;
    inverse_.y() = 1 / yy;
    zy_ = yz * inverse_.y();
    const double zz = H(2, 2) + s + lift.z() * n.z() - zx_ * xz - zy_ * yz;
    if (!(zz > least)) return;
    inverse_.z() = 1 / zz;
    is_regular_ = true;
  }

  bool is_regular() const { return is_regular_; }

  /// M^-1 b. M must be regular.
  Vector3 solve(const Vector3& b) const {
    const double y = b.y() - yx_ * b.x();
    const double z = (b.z() - zx_ * b.x() - zy_ * y) * inverse_.z();
    const double solved_y = y * inverse_.y() - zy_ * z;
    return {b.x() * inverse_.x() - yx_ * solved_y - zx_ * z, solved_y, z};
  }

 private:
  Vector3 inverse_;      // 1/m; of D
  double yx_, zx_, zy_;  // of L, below its diagonal of ones
  bool is_regular_ = false;
};

}  // namespace supernormal
