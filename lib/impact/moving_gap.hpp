// The gap of two bodies in steady motion, as a function of time.
#pragma once

#include "impact/body_rotation.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// The gap of two moving bodies, and bounds on it between two times. Results are in a frame that moves with the centre of body 1
/// and does not rotate. So a common velocity and the distance from the origin cost no digits.
class MovingGap {
 public:
  MovingGap(const Motion& motion1, const Motion& motion2, const BodyRotation& rotation1, const BodyRotation& rotation2);
  MovingGap(const MovingGap&) = delete;
  MovingGap(MovingGap&&) = delete;
  MovingGap& operator=(const MovingGap&) = delete;
  MovingGap& operator=(MovingGap&&) = delete;
  virtual ~MovingGap() = default;

  /// The proximity at time t, to `tolerance` (m). Takes at most `most_evaluations`. The search starts at `first_normal` (world
  /// frame) unless it is null.
  virtual Proximity find(double t, const Vector3* first_normal, double tolerance, int most_evaluations) = 0;

  /// The proximity with the normal n at time t; n need not be a common normal. Its gap is s(n).
  virtual Proximity evaluate(const Vector3& n, double t) = 0;

  /// The smallest half-extent of the bodies, m.
  virtual double length_unit() const = 0;

  /// Whether the bounding balls about the centres are separate at time t and move apart. Only for rotating bodies.
  virtual bool is_parting(double t) const = 0;

  /// The unit normal that separates these balls at time t.
  virtual Vector3 parting_normal(double t) const = 0;

  /// The rounding error of s at any time in [0, t], m.
  double rounding(double t) const;

  /// The last time, at most `horizon`, until which the rounding error of s is at most `rounding` (m); s.
  double known_until(double rounding, double horizon) const;

  /// The rate of s at time t, at the normal of the proximity, m/s. An estimate: on a face another point may determine it.
  double rate(const Proximity& proximity, double t) const;

  /// A lower bound of s at the normal of the proximity, which is of time t, however the bodies rotate afterwards: a rotating body
  /// counts as the ball about its centre, m. Its rate is the product of the normal and velocity().
  double gap_of_balls(const Proximity& proximity, double t) const;

  const Vector3& velocity() const { return velocity_; }  ///< m/s; of the centre of body 2 relative to the centre of body 1

  /// Upper bound of the rate of any gap, m/s.
  double fastest() const { return velocity_.norm() + rotation1_.fastest() + rotation2_.fastest(); }

  bool is_rotating() const { return rotation1_.is_rotating() || rotation2_.is_rotating(); }

  /// The bound K of theory.md, m/s^2. The normal rotates from n by `angle` (rad) with the rate `normal_rate` (rad/s).
  double bound(const Vector3& n, double angle, double normal_rate) const {
    return 2 * normal_rate * velocity_.norm() + rotation1_.bound(n, angle, normal_rate) + rotation2_.bound(n, angle, normal_rate);
  }

  /// The origin of the results at time t.
  Vector3 origin(double t) const { return centre1_ + t * motion1_.velocity; }

  int evaluations() const { return evaluations_; }

 protected:
  const Motion& motion1() const { return motion1_; }
  const Motion& motion2() const { return motion2_; }
  const Vector3& first_centre1() const { return centre1_; }  // m; centre of body 1 at time 0
  double reach() const { return rotation1_.reach() + rotation2_.reach(); }

  /// From the centre of body 1 to the centre of body 2, m.
  Vector3 offset(double t) const { return centre_offset_ + t * velocity_; }

  /// The sum of the sizes and distances at time 0 that enter s, m.
  virtual double terms() const = 0;

  void count(int evaluations) { evaluations_ += evaluations; }

 private:
  const Motion& motion1_;
  const Motion& motion2_;
  const BodyRotation rotation1_, rotation2_;
  Vector3 centre1_;
  Vector3 centre_offset_;
  Vector3 velocity_;
  int evaluations_ = 0;
};

/// The gap of two shapes.
class MovingPair final : public MovingGap {
 public:
  /// Keeps references to shapes and motions.
  MovingPair(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2, Solver solver);

  Proximity find(double t, const Vector3* first_normal, double tolerance, int most_evaluations) override;
  Proximity evaluate(const Vector3& n, double t) override;
  double length_unit() const override { return length_unit_; }

  /// A time before which the bounding balls about the centres do not meet, s. It is 0 if neither body rotates, or if the balls
  /// overlap initially.
  double balls_meet(double horizon) const;

  bool is_parting(double t) const override;
  Vector3 parting_normal(double t) const override { return offset(t).stableNormalized(); }

 private:
  double terms() const override;
  Pose pose1(double t) const;
  Pose pose2(double t) const;

  const Shape& shape1_;
  const Shape& shape2_;
  Solver solver_;
  double length_unit_;
};

/// The gap of a body and a half-space at rest.
class MovingOverPlane final : public MovingGap {
 public:
  /// Keeps references to its arguments.
  MovingOverPlane(const Shape& shape, const Motion& motion, const Vector3& plane_normal, double plane_offset);

  Proximity find(double t, const Vector3* first_normal, double tolerance, int most_evaluations) override;
  Proximity evaluate(const Vector3& n, double t) override { return find(t, &n, 0, 1); }
  double length_unit() const override { return shape_.half_extents().minCoeff(); }
  bool is_parting(double t) const override;
  Vector3 parting_normal(double /*t*/) const override { return -plane_normal_; }

 private:
  double terms() const override;

  const Shape& shape_;
  const Vector3& plane_normal_;
  double plane_offset_;
};

}  // namespace supernormal
