#include "rattleback.hpp"

#include <supernormal/supernormal.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lab.hpp"

namespace single_bodies {
namespace {

/// Creates the ellipsoid on its own body, at the origin.
dBodyID create_body(dWorldID world, dSpaceID space) {
  const dGeomID geom = snCreateEllipsoid(space, dReal(0.2), dReal(0.03), dReal(0.02));
  if (geom == nullptr) throw std::runtime_error(snLastError());
  dMass mass;
  dMassSetParameters(&mass, 1, 0, 0, 0, dReal(2e-4), dReal(1.6e-3), dReal(1.7e-3), dReal(-2e-5), 0, 0);
  const dBodyID body = dBodyCreate(world);
  dBodySetMass(body, &mass);
  dGeomSetBody(geom, body);
  dGeomSetOffsetPosition(geom, 0, 0, dReal(0.01));
  return body;
}

void tilt(dBodyID body) {
  dMatrix3 about_x;
  dMatrix3 about_y;
  dMatrix3 orientation;
  dRFromAxisAndAngle(about_x, 1, 0, 0, dReal(0.5 * kDegree));
  dRFromAxisAndAngle(about_y, 0, 1, 0, dReal(0.5 * kDegree));
  dMultiply0_333(orientation, about_x, about_y);
  dBodySetRotation(body, orientation);
}

/// The lowest point of a body at the origin.
Vector3 lowest_point(dBodyID body) {
  const dVector3 down = {0, 0, -1, 0};
  dVector3 lowest;
  if (snGeomSupport(dBodyGetFirstGeom(body), down, lowest) != 1) throw std::runtime_error(snLastError());
  return Vector3(lowest[0], lowest[1], lowest[2]);
}

}  // namespace

Rattleback::Rattleback(dWorldID world, dSpaceID space, double spin) : body_(create_body(world, space)) {
  tilt(body_);
  const Vector3 contact = lowest_point(body_);
  const Vector3 w = spin * third_axis(body_);
  set_position(body_, {0, 0, -contact.z()});
  set_spin(body_, w);
  set_velocity(body_, -w.cross(contact));
}

void Rattleback::follow() {
  const dReal* const R = dBodyGetRotation(body_);
  const double angle = std::atan2(-R[1], R[0]);
  yaw_ += std::remainder(angle - yaw_, 2 * std::numbers::pi);
}

double Rattleback::spin() const { return single_bodies::spin(body_).dot(third_axis(body_)); }

}  // namespace single_bodies
