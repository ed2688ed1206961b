#include "ode/geom/look_ahead.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <atomic>
#include <string>

#include "base/finite.hpp"
#include "base/validation.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "supernormal/impact/motion.hpp"

namespace supernormal::ode {
namespace {

// The fraction of an overlap that a step corrects. The overlap that remains is the solver's residual velocity times step / ERP. So
// beds of 80 grains at 2 ms overlap by 0.3 of what they do with ODE's 0.2. From 1 on, the correction would overshoot.
constexpr double kErp = 0.8;

std::atomic<double> default_time{0};

/// The inverse of the inertia tensor times the mass, world frame, 1/m^2.
Matrix3 turning_of(dBodyID body, const dMass& mass) {
  const Matrix3 rotation = to_rotation(dBodyGetRotation(body));
  return double{mass.mass} * (rotation * to_rotation(mass.I).inverse() * rotation.transpose());
}

/// Whether contacts are all that may hold the body. The torques of other joints are not known before the step.
bool is_loose(dBodyID body) {
  int joint = 0;
  while (joint < dBodyGetNumJoints(body) && dJointGetType(dBodyGetJoint(body, joint)) == dJointTypeContact) ++joint;
  return joint == dBodyGetNumJoints(body);
}

/// The angular velocity after a step of `time` without joints, as ODE finds it, rad/s. A rotation changes its axis by itself if
/// the moments of inertia are unequal. ODE's step of this is implicit.
Vector3 angular_velocity_after(dBodyID body, const dMass& mass, const MotionAhead& motion, double time) {
  Vector3 after = motion.angular_velocity;
  if (dBodyGetGyroscopicMode(body) != 0) {
    const Matrix3 rotation = to_rotation(dBodyGetRotation(body));
    const Vector3 momentum = rotation * (to_rotation(mass.I) * (rotation.transpose() * after)) / double{mass.mass};
    Matrix3 implicit = Matrix3::Identity();
    for (int axis = 0; axis < 3; ++axis) implicit.col(axis) -= time * (motion.turning * momentum.cross(Vector3::Unit(axis)));
    after = implicit.inverse() * after;
  }
  return after + time / double{mass.mass} * (motion.turning * to_vector(dBodyGetTorque(body)));
}

// ODE aborts on a box that is not finite.
void require_in_range(const MotionAhead& motion, dGeomID geom) {
  const auto within = [&](const char* what, const Vector3& value, const char* unit) {
    if (all_within(value, kMaxMotion)) return;
    const std::string name = what + (" of the body of " + geom_class_name(geom));
    for (const double number : value) require_in(name.c_str(), number, -kMaxMotion, kMaxMotion, unit);
  };
  within("angular velocity", motion.angular_velocity, "rad/s");
  within("velocity", motion.velocity, "m/s");
  within("acceleration", motion.acceleration, "m/s^2");
  within("angular acceleration", motion.angular_acceleration, "rad/s^2");
}

}  // namespace

double default_look_ahead() { return default_time.load(std::memory_order_relaxed); }

void set_default_look_ahead(double time) { default_time.store(time, std::memory_order_relaxed); }

bool looks_ahead(const dContactGeom& contact) {
  const auto looks = [](dGeomID geom) {
    const Body* const body = find_body(geom);
    return body != nullptr && body->look_ahead() > 0;
  };
  return looks(contact.g1) || looks(contact.g2);
}

void correct_leftover(dSurfaceParameters& surface) {
  if ((surface.mode & dContactSoftERP) != 0) return;
  surface.mode |= dContactSoftERP;
  surface.soft_erp = to_real(kErp);
}

Vector3 acceleration_of(dBodyID body, const dMass& mass) {
  Vector3 acceleration = to_vector(dBodyGetForce(body)) / mass.mass;
  if (dBodyGetGravityMode(body) != 0) {
    dVector3 gravity;
    dWorldGetGravity(dBodyGetWorld(body), gravity);
    acceleration += to_vector(gravity);
  }
  return acceleration;
}

// The centre of the body moves in a straight line. The origin of the geom moves about it along the tangent. It deviates from the
// tangent by at most twice its distance from the centre times the angle.
MotionAhead motion_ahead_of(dGeomID geom, const Vector3& origin, double radius, double time) {
  MotionAhead motion;
  motion.centre = origin;
  const dBodyID body = dGeomGetBody(geom);
  if (body == nullptr) return motion;
  motion.centre = to_vector(dBodyGetPosition(body));
  dMass mass;
  dBodyGetMass(body, &mass);
  if (dBodyIsKinematic(body) == 0) {
    motion.mobility = 1 / double{mass.mass};
    motion.turning = turning_of(body, mass);
  }
  if (dBodyIsEnabled(body) == 0) return motion;
  motion.angular_velocity = to_vector(dBodyGetAngularVel(body));
  const Vector3 from_centre = origin - motion.centre;
  motion.velocity = to_vector(dBodyGetLinearVel(body)) + motion.angular_velocity.cross(from_centre);
  motion.arm = radius + 2 * from_centre.norm();
  motion.turns_along_tangent = dBodyGetFiniteRotationMode(body) == 0;
  if (motion.mobility > 0) {
    motion.acceleration = acceleration_of(body, mass);
    if (time > 0 && is_loose(body))
      motion.angular_acceleration = (angular_velocity_after(body, mass, motion, time) - motion.angular_velocity) / time;
  }
  require_in_range(motion, geom);
  return motion;
}

}  // namespace supernormal::ode
