// A grain in an ODE world, and vectors of ODE.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

#include "common/motion.hpp"
#include "model/geometry.hpp"
#include "model/scene.hpp"
#include "placement.hpp"

namespace falling_particles {

using namespace common;

inline Vector3 to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }
inline Vector3 to_vector(const Point& p) { return {p[0], p[1], p[2]}; }
inline Point to_point(const dReal* v) { return {v[0], v[1], v[2]}; }
inline Point to_point(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// `vector`: rad, along the axis.
inline Eigen::Quaterniond rotation_by(const Vector3& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle)) : Eigen::Quaterniond::Identity();
}

/// Grain::move of a body that the stepper moves; null for quickstep.
inline WallVelocity* move_by_stepper(dBodyID body) { return static_cast<WallVelocity*>(dBodyGetData(body)); }

/// m/s, the velocity with which a body was moved in the last step. By quickstep it is the new velocity before [damping], which ODE
/// applies after the move. 0 if damping has taken all of it.
inline Vector3 velocity_of_move(dBodyID body) {
  if (const auto* const move = move_by_stepper(body)) return move->linear;
  const double kept = 1 - dBodyGetLinearDamping(body);
  return kept > 0 ? Vector3(to_vector(dBodyGetLinearVel(body)) / kept) : Vector3(Vector3::Zero());
}

/// m, of a body before the last step (s).
inline Vector3 position_before(dBodyID body, double step) {
  return to_vector(dBodyGetPosition(body)) - step * velocity_of_move(body);
}

/// rad/s, as velocity_of_move() of the angular velocity.
inline Vector3 spin_of_move(dBodyID body) {
  if (const auto* const move = move_by_stepper(body)) return move->angular;
  const double kept = 1 - dBodyGetAngularDamping(body);
  return kept > 0 ? Vector3(to_vector(dBodyGetAngularVel(body)) / kept) : Vector3(Vector3::Zero());
}

/// Category bits of the geoms of a world. Walls collide with grains only.
inline constexpr unsigned long kWallBit = 1;
inline constexpr unsigned long kGrainBit = 2;

/// m, a box around a geom: least x, most x, least y, most y, least z, most z.
using Aabb = std::array<dReal, 6>;
Aabb aabb_of(dGeomID geom);
bool meet(const Aabb& a, const Aabb& b);

/// A grain of a world. Its index in the world's list is never reused, also after its removal.
struct Grain {
  dBodyID body;  ///< null for a removed grain, which keeps only kind, scale and mass.mass
  dGeomID geom;  ///< of a compound the first one; geoms() returns all
  const GrainKind* kind;
  dMass mass;
  double scale = 1;                ///< factor on the lengths of the kind
  common::WallVelocity move = {};  ///< mean of the last step, if the stepper makes it; dBodyGetData points to it

  bool is_present() const { return body != nullptr; }
  std::vector<dGeomID> geoms() const;
  Aabb aabb() const;                                                                ///< of all geoms together
  double smallest_half_axis() const { return scale * kind->smallest_half_axis(); }  ///< m
  double bounding_radius() const { return scale * kind->bounding_radius(); }        ///< m
  double volume() const { return mass.mass / kind->density; }                       ///< m^3
  Point position() const { return to_point(dBodyGetPosition(body)); }               ///< m, of the centre
  std::array<double, 4> quaternion() const {                                        ///< w, x, y, z
    const dReal* q = dBodyGetQuaternion(body);
    return {q[0], q[1], q[2], q[3]};
  }
  Point velocity() const { return to_point(dBodyGetLinearVel(body)); }           ///< m/s
  Point angular_velocity() const { return to_point(dBodyGetAngularVel(body)); }  ///< rad/s
};

/// The grain of a geom in a World. Null for a wall, whose mesh may have data of its own.
inline const Grain* grain_of(dGeomID geom) {
  return dGeomGetCategoryBits(geom) == kGrainBit ? static_cast<const Grain*>(dGeomGetData(geom)) : nullptr;
}

/// Creates a geom of the library for a convex body with its lengths times `scale`. Throws std::runtime_error when the library
/// refuses it.
dGeomID create_geom(dSpaceID space, const ConvexBody& body, double scale = 1);

/// Attaches the geoms of a kind of grain to `body`, each in its place, with lengths times `scale` and with `data`. Returns the
/// first one. Throws std::runtime_error when the library refuses one.
dGeomID attach_geoms(dSpaceID space, const GrainKind& kind, double scale, dBodyID body, void* data);

/// Sets the position, orientation and velocities of a body.
void put(dBodyID body, const Placement& place);

/// The mass and inertia of a grain about its centre. The grain must have its geoms. Throws std::runtime_error when the library
/// refuses them.
dMass mass_of(const Grain& grain);

/// J, of translation and rotation.
double kinetic_energy(const Grain& grain);

/// J, kinetic and potential energy; 0 at rest at the origin.
double energy_of(const Grain& grain, const Scene& scene);

}  // namespace falling_particles
