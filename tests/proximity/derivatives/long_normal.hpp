// The common normal in long double, and derivatives of it by differences.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "support/long_body.hpp"

namespace supernormal::test {

/// The pose in long double, its matrix made orthonormal beyond double precision.
LongPose exact_pose(const Pose& pose);

struct LongAnswer {
  Real gap = 0;
  Real3 normal = Real3::Zero(), point1 = Real3::Zero(), point2 = Real3::Zero();
  bool is_exact = false;  // whether the residual is rounding
};

/// The stationary point of s near a normal, with the faces and edges of that normal kept.
class LongNormal {
 public:
  /// `normal`: world frame.
  LongNormal(const Shape& shape1, const LongPose& pose1, const Shape& shape2, const LongPose& pose2, const Vector3& normal);

  /// The answer after both poses have moved, or with other bodies of the same kinds.
  LongAnswer solve(const LongPose& pose1, const LongPose& pose2, const LongBody& exact1, const LongBody& exact2) const;
  LongAnswer solve(const LongPose& pose1, const LongPose& pose2) const { return solve(pose1, pose2, *body1_, *body2_); }

  const LongBody& body1() const { return *body1_; }
  const LongBody& body2() const { return *body2_; }

 private:
  std::shared_ptr<const LongBody> body1_, body2_;
  Real3 normal1_;                       // the start in body 1's frame
  std::vector<Real3> edges1_, edges2_;  // each in its body's frame
};

}  // namespace supernormal::test
