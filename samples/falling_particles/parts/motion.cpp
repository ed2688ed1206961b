#include "parts/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace falling_particles {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSecondsPerMinute = 60;

/// Whole turns are left out before they cost digits.
Eigen::Quaterniond turned(const Rotation& rotation, double seconds) {
  const double turns = rotation.rpm * seconds / kSecondsPerMinute;
  return Eigen::Quaterniond(Eigen::AngleAxisd(kTurn * (turns - std::floor(turns)), rotation.axis));
}

Vector3 displacement(const PartMotion& motion, double seconds) {
  if (const auto* translation = std::get_if<Translation>(&motion.kind)) return seconds * translation->velocity;
  if (const auto* vibration = std::get_if<Vibration>(&motion.kind)) {
    const double cycles = vibration->frequency * seconds;
    const double angle = kTurn * (cycles - std::floor(cycles));
    return (std::sin(angle + vibration->phase) - std::sin(vibration->phase)) * vibration->amplitude;
  }
  return Vector3::Zero();
}

}  // namespace

double PartMotion::elapsed(double time) const { return std::max(0.0, std::min(time, until) - from); }

PartPose pose_at(const PartPose& start, std::span<const PartMotion> motions, double time) {
  PartPose pose = start;
  Vector3 moved = Vector3::Zero();
  for (std::size_t k = motions.size(); k-- > 0;) {
    const PartMotion& motion = motions[k];
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

PartVelocity mean_velocity(const PartPose& from, const PartPose& to, double duration) {
  const Eigen::Quaterniond turn = to.rotation * from.rotation.conjugate();
  // Twice the arctangent keeps the digits of small turns, which the arccosine of w would lose.
  const double sine = turn.vec().norm();
  const double angle = 2 * std::atan2(sine, std::abs(turn.w()));
  const double sign = turn.w() < 0 ? -1 : 1;
  PartVelocity velocity{(to.position - from.position) / duration, Vector3::Zero()};
  if (sine > 0) velocity.angular = sign * angle / (sine * duration) * turn.vec();
  return velocity;
}

PartVelocity conveyor_velocity(const PartPose& start, const PartPose& now, std::span<const PartMotion> motions, double from,
                               double until) {
  PartVelocity sum;
  const Eigen::Quaterniond turned_by = now.rotation * start.rotation.conjugate();
  for (const PartMotion& motion : motions) {
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

}  // namespace falling_particles
