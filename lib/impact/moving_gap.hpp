// The gap of two bodies in steady motion at any time.
#pragma once

#include "impact/turning.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// The gap of two moving bodies, and what is proved of it between two times. Answers are in a frame whose origin moves with the
/// centre of body 1 and which does not turn, so that a common velocity and the distance from the origin cost no digits.
class MovingGap {
 public:
  MovingGap(const Motion& motion1, const Motion& motion2, const Turning& turning1, const Turning& turning2);
  MovingGap(const MovingGap&) = delete;
  MovingGap(MovingGap&&) = delete;
  MovingGap& operator=(const MovingGap&) = delete;
  MovingGap& operator=(MovingGap&&) = delete;
  virtual ~MovingGap() = default;

  /// The proximity at time t, to `tolerance` (m), in no more than `most_evaluations`; `first_normal` (world frame) is where the
  /// search starts, or null.
  virtual Proximity find(double t, const Vector3* first_normal, double tolerance, int most_evaluations) = 0;

  /// The proximity with the normal n at time t, whether it is a common normal or not: its gap is s(n).
  virtual Proximity evaluate(const Vector3& n, double t) = 0;

  /// m; the smallest half-extent of the bodies.
  virtual double length_unit() const = 0;

  /// Whether balls that hold the bodies, about their centres, are apart at time t and never meet again. Only for bodies that turn.
  virtual bool is_parting(double t) const = 0;

  /// Unit; the normal that separates those balls at time t.
  virtual Vector3 parting_normal(double t) const = 0;

  /// m; the rounding of s, at any time in [0, t].
  double rounding(double t) const;

  /// s; no later than `horizon`; until then the rounding of s is no more than `rounding` (m).
  double known_until(double rounding, double horizon) const;

  /// m/s; how fast s at the normal of a proximity, at the time t, changes. An estimate: on a face another point may decide.
  double rate(const Proximity& proximity, double t) const;

  /// m/s; no gap changes faster.
  double fastest() const { return velocity_.norm() + turning1_.fastest() + turning2_.fastest(); }

  bool is_turning() const { return turning1_.is_turning() || turning2_.is_turning(); }

  /// m/s^2; the bound K of README.md for a normal that turns by `angle` (rad), from n on, with the angular velocity `turn` (rad/s).
  double bound(const Vector3& n, double angle, double turn) const {
    return 2 * turn * velocity_.norm() + turning1_.bound(n, angle, turn) + turning2_.bound(n, angle, turn);
  }

  /// Where the answers at time t have their origin.
  Vector3 origin(double t) const { return centre1_ + t * motion1_.velocity; }

  int evaluations() const { return evaluations_; }

 protected:
  const Motion& motion1() const { return motion1_; }
  const Motion& motion2() const { return motion2_; }
  const Vector3& first_centre1() const { return centre1_; }  // m; of body 1 at time 0
  double reach() const { return turning1_.reach() + turning2_.reach(); }

  /// m; from the centre of body 1 to that of body 2.
  Vector3 offset(double t) const { return centre_offset_ + t * velocity_; }
  const Vector3& velocity() const { return velocity_; }  // m/s; of the centre of body 2 against that of body 1

  /// m; the sizes and distances at time 0 of which s is the sum.
  virtual double terms() const = 0;

  void count(int evaluations) { evaluations_ += evaluations; }

 private:
  const Motion& motion1_;
  const Motion& motion2_;
  const Turning turning1_, turning2_;
  Vector3 centre1_;
  Vector3 centre_offset_;
  Vector3 velocity_;
  int evaluations_ = 0;
};

/// Two shapes.
class MovingPair final : public MovingGap {
 public:
  /// Keeps references to shapes and motions.
  MovingPair(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2, Solver solver);

  Proximity find(double t, const Vector3* first_normal, double tolerance, int most_evaluations) override;
  Proximity evaluate(const Vector3& n, double t) override;
  double length_unit() const override { return length_unit_; }

  /// s; balls that hold the bodies, about their centres, do not meet before; 0 where neither body turns, and where they overlap at
  /// first.
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

/// A body and a half-space that stands still.
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
