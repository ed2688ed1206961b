#include "common/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace common {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSecondsPerMinute = 60;

/// Drops whole revolutions first, because they would cost digits.
Eigen::Quaterniond turned(const Rotation& rotation, double seconds) {
  const double turns = rotation.rpm * seconds / kSecondsPerMinute;
  return Eigen::Quaterniond(Eigen::AngleAxisd(kTurn * (turns - std::floor(turns)), rotation.axis));
}

Eigen::Matrix3d cross_matrix(const Vector3& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// The rotation matrix minus the identity, accurate for small angles.
Eigen::Matrix3d less_identity(const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d cross = cross_matrix(rotation.vec());
  return 2 * rotation.w() * cross + 2 * cross * cross;
}

/// The motion of the wall's surface relative to the wall in a step: a lever from the wall's position becomes rotation lever +
/// shift.
struct SurfaceStep {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vector3 shift = Vector3::Zero();  // m
};

SurfaceStep surface_step(const WallPose& start, const Eigen::Quaterniond& turned_by, std::span<const WallMotion> motions,
                         double from, double until) {
  SurfaceStep step;
  for (const WallMotion& motion : motions) {
    const auto* conveyor = std::get_if<Conveyor>(&motion.kind);
    if (conveyor == nullptr) continue;
    const double seconds = motion.elapsed(until) - motion.elapsed(from);
    step.shift += seconds * (turned_by * conveyor->velocity);
    const double angle = kTurn / kSecondsPerMinute * conveyor->turn.rpm * seconds;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, turned_by * conveyor->turn.axis));
    const Vector3 axis_point = turned_by * (conveyor->turn.point - start.position);
    step.shift = axis_point + turn * (step.shift - axis_point);
    step.rotation = turn * step.rotation;
  }
  return step;
}

Vector3 displacement(const WallMotion& motion, double seconds) {
  if (const auto* translation = std::get_if<Translation>(&motion.kind)) return seconds * translation->velocity;
  if (const auto* vibration = std::get_if<Vibration>(&motion.kind)) {
    const double cycles = vibration->frequency * seconds;
    const double angle = kTurn * (cycles - std::floor(cycles));
    return (std::sin(angle + vibration->phase) - std::sin(vibration->phase)) * vibration->amplitude;
  }
  return Vector3::Zero();
}

}  // namespace

Eigen::Quaterniond rotation_between(const Vector3& from, const Vector3& to) {
  const Vector3 a = from.normalized();
  const Vector3 b = to.normalized();
  const Vector3 cross = a.cross(b);
  const double twice_cosine = std::sqrt((1 + b.dot(a)) * 2);  // of half the angle
  Eigen::Quaterniond rotation;
  rotation.w() = twice_cosine / 2;
  rotation.vec() = cross * (1 / twice_cosine);
  if (twice_cosine > 0.01) return rotation;
  // Almost opposite: the sum has lost its digits, the product has not. Where it vanishes, any axis across will do.
  const double sine = std::sqrt((1 - b.dot(a)) / 2);
  const Vector3 across = a.cross(std::abs(a.x()) > std::abs(a.z()) ? Vector3::UnitY() : Vector3::UnitX());
  rotation.w() = cross.norm() / (2 * sine);
  rotation.vec() = sine * (cross.isZero(0) ? across : cross).normalized();
  return rotation;
}

double WallMotion::elapsed(double time) const { return std::max(0.0, std::min(time, until) - from); }

WallPose pose_at(const WallPose& start, std::span<const WallMotion> motions, double time) {
  WallPose pose = start;
  Vector3 moved = Vector3::Zero();
  for (std::size_t k = motions.size(); k-- > 0;) {
    const WallMotion& motion = motions[k];
    const double seconds = motion.elapsed(time);
    if (const auto* rotation = std::get_if<Rotation>(&motion.kind)) {
      const Eigen::Quaterniond turn = turned(*rotation, seconds);
      pose.position = rotation->point + turn * (pose.position - rotation->point);
      pose.rotation = turn * pose.rotation;
    } else {
      moved += displacement(motion, seconds);
    }
  }
  pose.position += moved;
  pose.rotation.normalize();
  return pose;
}

WallVelocity mean_velocity(const WallPose& from, const WallPose& to, double duration) {
  const Eigen::Quaterniond turn = to.rotation * from.rotation.conjugate();
  // Twice the arctangent keeps the digits of small angles, which the arccosine of w would lose.
  const double sine = turn.vec().norm();
  const double angle = 2 * std::atan2(sine, std::abs(turn.w()));
  const double sign = turn.w() < 0 ? -1 : 1;
  WallVelocity velocity{(to.position - from.position) / duration, Vector3::Zero()};
  if (sine > 0) velocity.angular = sign * angle / (sine * duration) * turn.vec();
  return velocity;
}

WallVelocity conveyor_velocity(const WallPose& start, const WallPose& now, std::span<const WallMotion> motions, double from,
                               double until) {
  WallVelocity sum;
  const Eigen::Quaterniond turned_by = now.rotation * start.rotation.conjugate();
  for (const WallMotion& motion : motions) {
    const auto* conveyor = std::get_if<Conveyor>(&motion.kind);
    if (conveyor == nullptr) continue;
    const double share = (motion.elapsed(until) - motion.elapsed(from)) / (until - from);
    sum.linear += share * (turned_by * conveyor->velocity);
    if (conveyor->turn.rpm == 0) continue;
    const Vector3 spin = share * kTurn / kSecondsPerMinute * conveyor->turn.rpm * (turned_by * conveyor->turn.axis);
    sum.angular += spin;
    sum.linear += spin.cross(turned_by * (start.position - conveyor->turn.point));
  }
  return sum;
}

ChordExcess::ChordExcess(const Eigen::Quaterniond& rotation, const Vector3& shift, const WallVelocity& rigid, double duration)
    : turn_(rotation.toRotationMatrix()),
      chord_(less_identity(rotation) / duration),
      chord_at_wall_(shift / duration),
      rigid_(rigid),
      duration_(duration) {}

Vector3 ChordExcess::at(const Vector3& lever, const Vector3& velocity) const {
  const Vector3 chord = chord_at_wall_ + chord_ * lever;
  const Vector3 excess = (chord_at_wall_ - rigid_.linear) + (chord_ * lever - rigid_.angular.cross(lever));
  // A grain that rides along has, at the end of the step, its velocity rotated with the surface: the velocity of the chord.
  return excess + duration_ / 2 * rigid_.angular.cross(turn_ * velocity - chord);
}

std::optional<ChordExcess> chord_excess(const WallPose& start, const WallPose& now, const WallPose& next,
                                        std::span<const WallMotion> motions, double from, double until) {
  const double duration = until - from;
  const WallVelocity wall = mean_velocity(now, next, duration);
  const WallVelocity conveyor = conveyor_velocity(start, now, motions, from, until);
  if (wall.angular.isZero(0) && conveyor.angular.isZero(0)) return std::nullopt;
  const Eigen::Quaterniond turn = next.rotation * now.rotation.conjugate();
  const SurfaceStep surface = surface_step(start, now.rotation * start.rotation.conjugate(), motions, from, until);
  return ChordExcess(turn * surface.rotation, next.position - now.position + turn * surface.shift,
                     {wall.linear + conveyor.linear, wall.angular + conveyor.angular}, duration);
}

}  // namespace common
