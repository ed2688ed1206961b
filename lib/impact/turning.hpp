// How far and how sharply the points of a body move that turns.
#pragma once

#include "supernormal/impact/motion.hpp"

namespace supernormal {

/// The rotation at `time`, s.
Matrix3 rotation_at(const Motion& motion, double time);

/// Bounds for a body about its centre, Motion::centre, while it turns.
class Turning {
 public:
  Turning(const Shape& shape, const Motion& motion);

  bool is_turning() const { return speed_ > 0; }

  /// m; a ball of this radius about the centre holds the body. Of one that does not turn it is an estimate.
  double reach() const { return reach_; }

  /// m/s; no point of the body moves faster about the centre.
  double fastest() const { return speed_ * axis_distance_; }

  /// m/s^2; bounds n.q'' + 2 n'.q' for every point q of the body, from its centre, while the unit normal turns from n by no more
  /// than `angle` (rad), with the angular velocity `turn` (rad/s) at most. Points of a body of revolution are those that do not
  /// spin about its axis: at every time they make up the same body.
  double bound(const Vector3& n, double angle, double turn) const;

 private:
  void use_axis(const Shape& shape, const Motion& motion);

  Vector3 axis_ = Vector3::UnitX();  // of the rotation, unit
  double speed_ = 0;                 // rad/s
  double reach_ = 0;                 // m
  double axis_distance_ = 0;         // m; no point of the body is farther from the axis of the rotation
  bool is_revolved_ = false;         // the body is one of revolution, and
  double pivot_distance_ = 0;        // m; of a point of its axis from the centre
  double follow_speed_ = 0;          // rad/s; of the points about that one
  double follow_acceleration_ = 0;   // rad/s^2
};

}  // namespace supernormal
