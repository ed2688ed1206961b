// A grain in an ODE world.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

#include "common/motion.hpp"
#include "model/scene.hpp"
#include "placement.hpp"

namespace falling_particles {

/// Category bits of the geoms of a world. Walls collide with grains only.
inline constexpr unsigned long kWallBit = 1;
inline constexpr unsigned long kGrainBit = 2;

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
  /// m; of all geoms together: least x, most x, least y, most y, least z, most z.
  std::array<dReal, 6> aabb() const;
  double smallest_half_axis() const { return scale * kind->smallest_half_axis(); }  ///< m
  double bounding_radius() const { return scale * kind->bounding_radius(); }        ///< m
  double volume() const { return mass.mass / kind->density; }                       ///< m^3
  Point position() const {                                                          ///< m, of the centre
    const dReal* p = dBodyGetPosition(body);
    return {p[0], p[1], p[2]};
  }
  std::array<double, 4> quaternion() const {  ///< w, x, y, z
    const dReal* q = dBodyGetQuaternion(body);
    return {q[0], q[1], q[2], q[3]};
  }
  Point velocity() const {  ///< m/s
    const dReal* v = dBodyGetLinearVel(body);
    return {v[0], v[1], v[2]};
  }
  Point angular_velocity() const {  ///< rad/s
    const dReal* w = dBodyGetAngularVel(body);
    return {w[0], w[1], w[2]};
  }
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
