// Bounds on the velocity and acceleration of the points of a rotating body.
#pragma once

#include "supernormal/impact/motion.hpp"

namespace supernormal {

/// The rotation at `time` (s).
Matrix3 rotation_at(const Motion& motion, double time);

/// Bounds for a body that rotates about Motion::centre.
class BodyRotation {
 public:
  BodyRotation(const Shape& shape, const Motion& motion);

  bool is_rotating() const { return speed_ > 0; }

  /// The radius of a ball about the centre that contains the body, m. An estimate if the body does not rotate.
  double reach() const { return reach_; }

  /// Upper bound of the speed of the body's points about the centre, m/s. The points of a body of revolution do not spin about its
  /// axis, as in bound().
  double fastest() const;

  /// Upper bound of n.q'' + 2 n'.q', m/s^2, for every point q of the body, relative to its centre. The unit normal rotates from n
  /// by at most `angle` (rad). Its rate is at most `normal_rate` (rad/s). In a body of revolution the points do not spin about its
  /// axis: they form the same body at every time.
  double bound(const Vector3& n, double angle, double normal_rate) const;

 private:
  void use_axis(const Shape& shape, const Motion& motion);

  Vector3 axis_ = Vector3::UnitX();  // rotation axis, unit
  double speed_ = 0;                 // rad/s
  double reach_ = 0;                 // m
  double axis_distance_ = 0;         // m; the farthest point's distance from the rotation axis
  bool is_revolved_ = false;         // body of revolution, with the following:
  double pivot_distance_ = 0;        // m; distance of a point of its axis from the centre
  double follow_speed_ = 0;          // rad/s; angular velocity about that point
  double follow_acceleration_ = 0;   // rad/s^2
};

}  // namespace supernormal
