// Prescribed motions of walls as functions of time.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace common {

using Vector3 = Eigen::Vector3d;

/// The smallest rotation that takes one direction to another; half a turn about an axis across opposite ones. Eigen's
/// FromTwoVectors takes a singular value decomposition there, which is seconds to compile.
Eigen::Quaterniond rotation_between(const Vector3& from, const Vector3& to);

/// The pose of a wall: a point x in its frame is at rotation x + position.
struct WallPose {
  Vector3 position = Vector3::Zero();  ///< m
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();

  Vector3 operator()(const Vector3& point) const { return rotation * point + position; }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(position[0], position[1], position[2], rotation.w(), rotation.x(), rotation.y(), rotation.z());
  }
};

/// The velocity of the wall's position, and its angular velocity.
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

/// A rotation about an axis.
struct Rotation {
  Vector3 axis;   ///< unit
  Vector3 point;  ///< m, on the axis at the start
  double rpm;     ///< revolutions per minute, anticlockwise as seen from the tip of the axis
};

/// A displacement by amplitude (sin(2 pi frequency t + phase) - sin phase), which is zero at the start.
struct Vibration {
  Vector3 amplitude;  ///< m, along the direction
  double frequency;   ///< Hz
  double phase;       ///< rad
};

/// The surface moves and the wall stands. The whole surface has this velocity: a face across it pushes with it.
struct Conveyor {
  Vector3 velocity;  ///< m/s, at the start; it rotates with the wall
  Rotation turn;     ///< of the surface about an axis of the wall; none for rpm = 0
};

/// One motion of a wall.
struct WallMotion {
  std::variant<Translation, Rotation, Vibration, Conveyor> kind;
  double from = 0;                                         ///< s, start
  double until = std::numeric_limits<double>::infinity();  ///< s, end; then the wall stays where it is

  double elapsed(double time) const;  ///< s, the time for which the motion has acted
};

/// The pose at `time` (s) of a wall that starts in `start`. It is an exact function of time, whatever the steps. Displacements add
/// up, along directions of the world. Rotations are about the places where their axes are at the start. The last rotation acts
/// first, then the ones before it, then the displacements. So an axis is carried by the displacements and by the rotations listed
/// before it.
WallPose pose_at(const WallPose& start, std::span<const WallMotion> motions, double time);

/// The constant velocity that leads from one pose to the other within `duration` (s), by the smaller rotation.
WallVelocity mean_velocity(const WallPose& from, const WallPose& to, double duration);

/// The mean velocity of the wall's surface by conveyors between two times (s). It is at the wall's position, in the world's frame.
/// `now` is the pose of the wall.
WallVelocity conveyor_velocity(const WallPose& start, const WallPose& now, std::span<const WallMotion> motions, double from,
                               double until);

/// The correction of a rigid velocity for the curved paths of a rotating wall. A rigid velocity gives each point of the wall the
/// tangent of its circle at the start of a step. The point itself moves along a chord. A grain on tangents moves outwards by
/// (angular velocity)^2 step / 2 times its distance from the axis in every second.
class ChordExcess {
 public:
  /// Of a surface that moves with the velocity `rigid` at the wall's position. Relative to that position, it is rotated by
  /// `rotation` and displaced by `shift` (m) in `duration` (s).
  ChordExcess(const Eigen::Quaterniond& rotation, const Vector3& shift, const WallVelocity& rigid, double duration);

  /// m/s, the velocity that a grain needs in addition to the rigid one. `lever` (m) leads from the wall's position to the grain's
  /// centre; `velocity` (m/s) is the grain's. A grain that rides along gets the chord of the surface's point at its centre. All its
  /// contacts ask for the same velocity, since the chords of its own points differ by as much. A grain that rolls is elsewhere in
  /// the middle of the step, and gets the velocity of the surface there.
  Vector3 at(const Vector3& lever, const Vector3& velocity) const;

 private:
  Eigen::Matrix3d turn_;   // of the step
  Eigen::Matrix3d chord_;  // 1/s; gradient of the chords' velocities
  Vector3 chord_at_wall_;  // m/s
  WallVelocity rigid_;
  double duration_;  // s
};

/// For the step from `from` to `until` (s). The wall moves from `now` to `next`, and conveyors move its surface. Empty if neither
/// rotates.
std::optional<ChordExcess> chord_excess(const WallPose& start, const WallPose& now, const WallPose& next,
                                        std::span<const WallMotion> motions, double from, double until);

}  // namespace common
