// What drives a wall along an axis, or about it.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/motion.hpp"

namespace common {

/// Two walls, by their names, whose planes or sides of boxes face each other.
using FacingWalls = std::array<std::string, 2>;

/// A target for the mean normal stress of the grains on a wall: their force along the axis over the area. The wall has the speed
/// gain (target - stress) with the stress of the same step.
struct Servo {
  double stress;                          ///< Pa, target
  double gain;                            ///< m/(s Pa)
  double largest_speed;                   ///< m/s
  double area = 0;                        ///< m^2; 0: the product of the distances in `between`, at any time
  std::vector<FacingWalls> between = {};  ///< two pairs, at right angles to the axis and to each other; empty if `area` is given
};

/// What drives a wall. It slides along the axis or, if there is a point, turns about the axis through the point. All other motion
/// follows its motions. Of two units, the first belongs to a wall that slides, the second to a wall that turns.
struct Drive {
  Vector3 axis;                                            ///< unit, at the start; it rotates with the wall
  double force;                                            ///< N or N m; with a power the limit of it
  double mass;                                             ///< kg or kg m^2, the inertia along or about the axis
  double damping = 0;                                      ///< N s/m or N m s, of the speed
  double from = 0;                                         ///< s; until then the wall is held
  double until = std::numeric_limits<double>::infinity();  ///< s; then only its weight acts, and a servo is held
  std::array<double, 2> travel = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};  ///< m or rad
  double hung_mass = 0;               ///< kg, of a wall that turns: its weight acts at the wall's position
  double power = 0;                   ///< W; 0: the force is constant
  std::optional<Vector3> point = {};  ///< m, on the axis at the start, of a wall that turns
  std::optional<Servo> servo = {};    ///< in place of force, mass, damping and power

  bool turns() const { return point.has_value(); }
};

/// N or N m, the push of a drive in a step (s) that starts with a speed (m/s or rad/s). With a power, it is the power over the mean
/// speed of the step, up to `force`. So a wall without other forces gains power times step, for any step. At rest, and while a load
/// pushes the wall back, it is `force`.
double push_of(const Drive& drive, double speed, double step);

/// The degree of freedom of a driven wall on its carrier: the wall with its prescribed motions alone. Positions are in m along the
/// axis, or in rad about it, speeds in m/s or rad/s.
class DrivenAxis {
 public:
  /// `start`: the pose of the wall before it moves.
  DrivenAxis(const Drive& drive, const WallPose& start);

  Vector3 axis_on(const WallPose& carrier) const;
  Vector3 point_on(const WallPose& carrier) const;  ///< m, on the axis of a wall that turns
  WallPose pose_on(const WallPose& carrier, double position) const;
  WallVelocity velocity_on(const WallPose& carrier, const WallVelocity& velocity, double position, double speed) const;
  /// N or N m, of the wall's weight along or about the axis. `gravity`: m/s^2.
  double weight_on(const WallPose& carrier, double position, const Vector3& gravity) const;

 private:
  Vector3 axis_;
  Eigen::Quaterniond to_wall_;     // from the world at the start
  std::optional<Vector3> anchor_;  // m, on the axis, in the frame of the wall
  double weighing_;                // kg; its weight acts at the wall's position
};

}  // namespace common
