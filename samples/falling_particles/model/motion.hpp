// Prescribed motions of parts, as functions of time.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace falling_particles {

using Vector3 = Eigen::Vector3d;

/// Where a part is: a point x of it is at rotation x + position.
struct WallPose {
  Vector3 position = Vector3::Zero();  ///< m
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  Vector3 operator()(const Vector3& point) const { return rotation * point + position; }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(position[0], position[1], position[2], rotation.w(), rotation.x(), rotation.y(), rotation.z());
  }
};

/// Of the body's position, and of the body.
struct WallVelocity {
  Vector3 linear = Vector3::Zero();   ///< m/s
  Vector3 angular = Vector3::Zero();  ///< rad/s

  bool is_zero() const { return linear.isZero(0) && angular.isZero(0); }

  template <typename Archive>
  void serialize(Archive& archive) {
    for (Vector3* vector : {&linear, &angular}) archive((*vector)[0], (*vector)[1], (*vector)[2]);
  }
};

/// A constant velocity.
struct Translation {
  Vector3 velocity;  ///< m/s
};

/// Turns about an axis.
struct Rotation {
  Vector3 axis;   ///< unit
  Vector3 point;  ///< m, of the axis, where it is at the start
  double rpm;     ///< revolutions a minute, anticlockwise as seen from the tip of the axis
};

/// Shakes by amplitude (sin(2 pi frequency t + phase) - sin phase): it starts where the part is.
struct Vibration {
  Vector3 amplitude;  ///< m, along the direction
  double frequency;   ///< Hz
  double phase;       ///< rad
};

/// The surface moves, and the part stands. The velocity is that of the whole surface, which a face across it pushes with.
struct Conveyor {
  Vector3 velocity;  ///< m/s, at the start; it turns with the part
  Rotation turn;     ///< of the surface about an axis of the part; none for rpm = 0
};

/// One motion of a part.
struct WallMotion {
  std::variant<Translation, Rotation, Vibration, Conveyor> kind;
  double from = 0;                                         ///< s, when it starts
  double until = std::numeric_limits<double>::infinity();  ///< s; then the part stays where it is

  double elapsed(double time) const;  ///< s, the time for which it has been on
};

/// The pose at a time (s) of a part that starts in `start`: an exact function of time, whatever the steps. Displacements add up,
/// and are along directions of the world. Rotations turn the part about the places where their axes are at the start, the last one
/// first, and are then displaced: an axis is carried by the displacements and by the rotations listed before.
WallPose pose_at(const WallPose& start, std::span<const WallMotion> motions, double time);

/// The constant velocity that leads from one pose to the other within `duration` (s), by the smaller turn.
WallVelocity mean_velocity(const WallPose& from, const WallPose& to, double duration);

/// The mean velocity that conveyors give the surface of the part from one time to another (s), in the world's frame, at the
/// position of the part, which is at `now`.
WallVelocity conveyor_velocity(const WallPose& start, const WallPose& now, std::span<const WallMotion> motions, double from,
                               double until);

/// A rigid velocity gives each point of a part that rotates the tangent of its circle at the start of a step, while the point moves
/// along a chord. A grain that was carried along tangents would move outwards by (angular velocity)^2 step / 2 times its distance
/// from the axis, in every second.
class ChordExcess {
 public:
  /// Of a surface that moves with the velocity `rigid` at the position of the part and is, relative to that position, turned by
  /// `rotation` and displaced by `shift` (m) in `duration` (s).
  ChordExcess(const Eigen::Quaterniond& rotation, const Vector3& shift, const WallVelocity& rigid, double duration);

  /// m/s; what a grain needs besides the rigid velocity. `lever`: m, from the position of the part to the grain's centre;
  /// `velocity`: m/s, of the grain. A grain that rides along gets the chord of the surface's point at its centre: all its contacts
  /// ask for the same, since the chords of its own points differ by as much. One that rolls is elsewhere in the middle of the step,
  /// and gets the velocity of the surface there.
  Vector3 at(const Vector3& lever, const Vector3& velocity) const;

 private:
  Eigen::Matrix3d turn_;   // of the step
  Eigen::Matrix3d chord_;  // 1/s; gradient of the chords' velocities
  Vector3 chord_at_wall_;  // m/s
  WallVelocity rigid_;
  double duration_;  // s
};

/// For the step from `from` to `until` (s), in which the part goes from `now` to `next`, and conveyors move its surface; empty if
/// neither of them rotates.
std::optional<ChordExcess> chord_excess(const WallPose& start, const WallPose& now, const WallPose& next,
                                        std::span<const WallMotion> motions, double from, double until);

}  // namespace falling_particles
