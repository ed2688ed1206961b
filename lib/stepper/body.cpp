#include "stepper/body.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ode/geom/convert.hpp"
#include "ode/support/require.hpp"

namespace supernormal::stepper {
namespace {

using ode::require_finite;
using ode::to_real;
using ode::to_vector;

// Relative to the size: a body that is this far off its path, and will be that far at the end of the step, asks for new contacts
// (README). Without, what a bullet throws on passes a wall.
constexpr double kOff = 0.1;
constexpr double kFarOff = 0.25;
constexpr double kFarTurned = 0.5;  // rad; the same for a body as long as twice its size

/// The orientation after a rotation (rad, world frame).
Eigen::Quaterniond turned(const Eigen::Quaterniond& orientation, const Vector3& rotation) {
  constexpr double kNoAngle = 1e-8;  // rad; sin(x)/x is 1 to rounding
  const double angle = rotation.norm();
  const Vector3 axis = (angle > kNoAngle ? std::sin(angle / 2) / angle : 0.5) * rotation;
  return (Eigen::Quaterniond(std::cos(angle / 2), axis.x(), axis.y(), axis.z()) * orientation).normalized();
}

/// A vector after a rotation (rad), to the second order.
Vector3 nearly_turned(const Vector3& vector, const Vector3& rotation) {
  const Vector3 change = rotation.cross(vector);
  return vector + change + 0.5 * rotation.cross(change);
}

/// 1 if the speed is not above the threshold of ODE's damping; the factor that ODE gives the velocity in `fraction` of a step.
double damping(const Vector3& velocity, double scale, double threshold, double fraction) {
  return scale > 0 && velocity.squaredNorm() > threshold * threshold ? std::pow(1 - scale, fraction) : 1;
}

/// kg m^2; the principal moments of inertia, in any order.
Vector3 principal_moments(const Matrix3& inertia) {
  if (inertia.isDiagonal(0)) return inertia.diagonal();
  Eigen::SelfAdjointEigenSolver<Matrix3> principal;
  principal.computeDirect(inertia, Eigen::EigenvaluesOnly);
  return principal.eigenvalues().cwiseMax(std::numeric_limits<double>::min());
}

}  // namespace

void Body::read(const Vector3& gravity, bool is_rest) {
  start = to_vector(dBodyGetPosition(id));
  const dReal* const q = dBodyGetQuaternion(id);
  orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  rotation = orientation.toRotationMatrix();
  velocity = first_velocity_ = to_vector(dBodyGetLinearVel(id));
  angular_velocity = to_vector(dBodyGetAngularVel(id));
  moved = rotated = acceleration_ = Vector3::Zero();
  is_touched = is_borne = is_followed = is_centred = false;
  max_angular_speed_ = dBodyGetMaxAngularSpeed(id);
  limit_angular_speed();
  first_angular_velocity_ = angular_velocity;
  is_free = dBodyIsKinematic(id) == 0;
  stirs = is_free || !velocity.isZero(0) || !angular_velocity.isZero(0);
  is_awake = stirs && dBodyIsEnabled(id) != 0;
  is_held = false;
  const Vector3 force = require_finite("force on a body", to_vector(dBodyGetForce(id)));
  const Vector3 torque = require_finite("torque on a body", to_vector(dBodyGetTorque(id)));
  if (!is_rest || !force.isZero(0) || !torque.isZero(0)) {
    force_ = force;
    torque_ = torque;
  }
  inverse_mass = 0;
  size = thickness = std::numeric_limits<double>::infinity();
  world_inverse_inertia.setZero();
  if (is_free) {
    read_mass();
    acceleration_ = inverse_mass * force_;
    if (dBodyGetGravityMode(id) != 0) acceleration_ += gravity;
  }
  keeps_momentum_ = is_free && dBodyGetGyroscopicMode(id) != 0;
  require_finite("position of a body", start);
  require_finite("unit quaternion of a body, x, y and z", orientation.vec());
  require_finite("velocity of a body", velocity);
  require_finite("angular velocity of a body", angular_velocity);
  require_finite("acceleration of a body", acceleration_);
}

void Body::read_mass() {
  dMass mass;
  dBodyGetMass(id, &mass);
  inverse_mass = 1 / double{mass.mass};
  inertia_ = ode::to_rotation(mass.I);
  inverse_inertia_ = inertia_.inverse();
  turn_inertia();
  const Vector3 moments = principal_moments(inertia_);
  size = std::sqrt(moments.minCoeff() * inverse_mass);
  thickness = std::sqrt(std::max(0.0, moments.sum() - 2 * moments.maxCoeff()) * inverse_mass);
}

void Body::restore_forces() const {
  dBodySetForce(id, to_real(force_.x()), to_real(force_.y()), to_real(force_.z()));
  dBodySetTorque(id, to_real(torque_.x()), to_real(torque_.y()), to_real(torque_.z()));
}

void Body::hold_still() {
  velocity = angular_velocity = acceleration_ = Vector3::Zero();
  inverse_mass = 0;
  size = std::numeric_limits<double>::infinity();
  world_inverse_inertia.setZero();
}

void Body::limit_angular_speed() {
  const double speed = angular_velocity.norm();
  if (speed > max_angular_speed_) angular_velocity *= max_angular_speed_ / speed;
}

void Body::apply_forces(double time) {
  if (!is_dynamic()) return;
  velocity += time * acceleration_;
  if (!torque_.isZero(0)) angular_velocity += time * spin_of(rotation, torque_);
}

void Body::advance(double time) {
  limit_angular_speed();
  Vector3 spin = angular_velocity;  // in the middle of the time
  Vector3 momentum;
  if (keeps_momentum_) {
    momentum = rotation * (inertia_ * (rotation.transpose() * spin));
    const Vector3 half = 0.5 * time * spin;
    spin = nearly_turned(spin_of(rotation, nearly_turned(momentum, -half)), half);
  }
  orientation = turned(orientation, time * spin);
  rotation = orientation.toRotationMatrix();
  if (keeps_momentum_) angular_velocity = spin_of(rotation, momentum);
  moved += time * velocity;
  rotated += time * spin;
  if (is_followed) turn_inertia();
}

bool Body::has_left_path(double time, double left) const {
  const Vector3 away = moved - time * first_velocity_ - 0.5 * time * time * acceleration_;
  const Vector3 away_then = away + left * (velocity - first_velocity_ - time * acceleration_);
  const Vector3 rotated_away = rotated - time * first_angular_velocity_;
  return (away.norm() > kOff * size && away_then.norm() > kFarOff * size) || rotated_away.norm() > kFarTurned;
}

void Body::watch(double time) {
  const int samples = dBodyGetAutoDisableAverageSamplesCount(id);
  is_restless = is_awake;
  if (!is_awake || dBodyGetAutoDisableFlag(id) == 0 || samples == 0) {
    rest_ = {};
    return;
  }
  rest_.travelled += moved;
  rest_.turned += rotated;
  rest_.time += time;
  if (++rest_.samples >= samples) {
    const bool is_slow = rest_.travelled.norm() <= rest_.time * dBodyGetAutoDisableLinearThreshold(id) &&
                         rest_.turned.norm() <= rest_.time * dBodyGetAutoDisableAngularThreshold(id);
    rest_ = {.idle_time = is_slow ? rest_.idle_time + rest_.time : 0, .idle_steps = is_slow ? rest_.idle_steps + rest_.samples : 0};
  }
  is_restless =
      rest_.idle_steps == 0 || rest_.idle_time < dBodyGetAutoDisableTime(id) || rest_.idle_steps < dBodyGetAutoDisableSteps(id);
}

void Body::write(double fraction) {
  if (dBodyIsEnabled(id) == 0) dBodyEnable(id);
  const Vector3 place = centre();
  dBodySetPosition(id, to_real(place.x()), to_real(place.y()), to_real(place.z()));
  const dQuaternion q = {to_real(orientation.w()), to_real(orientation.x()), to_real(orientation.y()), to_real(orientation.z())};
  dBodySetQuaternion(id, q);
  dBodySetForce(id, 0, 0, 0);
  dBodySetTorque(id, 0, 0, 0);
  if (!is_free) return;
  const Vector3 v = damping(velocity, dBodyGetLinearDamping(id), dBodyGetLinearDampingThreshold(id), fraction) * velocity;
  const Vector3 w =
      damping(angular_velocity, dBodyGetAngularDamping(id), dBodyGetAngularDampingThreshold(id), fraction) * angular_velocity;
  dBodySetLinearVel(id, to_real(v.x()), to_real(v.y()), to_real(v.z()));
  dBodySetAngularVel(id, to_real(w.x()), to_real(w.y()), to_real(w.z()));
}

}  // namespace supernormal::stepper
