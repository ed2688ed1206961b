// Shared helpers of the tests of motion: an ODE world that steps our bodies as a program does, and the energies of its bodies.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "support/ode_fixture.hpp"

namespace supernormal::test {

inline constexpr double kGravity = 9.81;  // m/s^2
inline constexpr double kDegree = std::numbers::pi / 180;

/// A world, its space (destroyed with it) and the near callback of every ODE program. It has ODE's defaults unless a test changes
/// them. The softness of constraints is the default in double precision. The default in single precision, 1e-5 s/kg, lets a body of
/// 3 kg creep down a slope at 0.04 mm/s.
class World {
 public:
  explicit World(dSpaceID space = dHashSpaceCreate(nullptr)) : id_(dWorldCreate()), space_(space), joints_(dJointGroupCreate(0)) {
    dWorldSetGravity(id_, 0, 0, dReal(-kGravity));
    dWorldSetCFM(id_, dReal(1e-10));
    dRandSetSeed(1);  // quickstep shuffles its rows with ODE's global generator
  }
  ~World() {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(space_);
    dWorldDestroy(id_);
  }
  World(const World&) = delete;
  World(World&&) = delete;
  World& operator=(const World&) = delete;
  World& operator=(World&&) = delete;

  dWorldID id() const { return id_; }
  dSpaceID space() const { return space_; }

  /// Adds a body with the mass of the geom for a density in kg/m^3.
  dBodyID add(dGeomID geom, double density) const {
    dMass mass;
    REQUIRE(snMassSet(&mass, dReal(density), geom) == 1);
    return add(geom, mass);
  }
  dBodyID add(dGeomID geom, const dMass& mass) const {
    const dBodyID body = dBodyCreate(id_);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    return body;
  }

  /// Adds the plane z = 0, tilted so that it rises along x at an angle (rad).
  void add_plane(double incline = 0) const { dCreatePlane(space_, dReal(-std::sin(incline)), 0, dReal(std::cos(incline)), 0); }

  void quick_step(double dt) {
    make_contacts(dt);
    dWorldQuickStep(id_, dReal(dt));
    dJointGroupEmpty(joints_);
  }
  /// Steps with the contacts of one pair of geoms; returns their number.
  int quick_step_of(dGeomID o1, dGeomID o2, double dt) { return quick_step_of(o1, {&o2, 1}, dt); }
  int quick_step_of(dGeomID geom, std::span<const dGeomID> others, double dt) {
    begin(dt);
    for (const dGeomID other : others) join(geom, other);
    dWorldQuickStep(id_, dReal(dt));
    dJointGroupEmpty(joints_);
    return contacts;
  }
  /// Steps with ODE's exact solver.
  void exact_step(double dt) {
    make_contacts(dt);
    dWorldStep(id_, dReal(dt));
    dJointGroupEmpty(joints_);
  }

  /// Coulomb's friction at every contact.
  void set_friction(double mu) {
    surface.mode = dContactApprox1;
    surface.mu = dReal(mu);
  }

  static constexpr int kRoom = 8;

  dSurfaceParameters surface{};  ///< parameters of every contact; frictionless unless set
  int room = kRoom;              ///< max_contacts of a pair, at most kRoom
  int contacts = 0;              ///< contacts in the last step
  int most_of_a_pair = 0;        ///< most contacts of a pair in any step
  double depth = 0;              ///< m; depth of the deepest contact in the last step

 private:
  void begin(double dt) {
    step_ = dt;
    contacts = 0;
    depth = 0;
  }

  void make_contacts(double dt) {
    begin(dt);
    dSpaceCollide(space_, this, [](void* self, dGeomID o1, dGeomID o2) { static_cast<World*>(self)->join(o1, o2); });
  }

  void join(dGeomID o1, dGeomID o2) {
    std::array<dContact, kRoom> found;
    const int count = dCollide(o1, o2, room, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface = surface;
      depth = std::max(depth, double{contact.geom.depth});
      snContactLookAhead(&contact, dReal(step_));
      dJointAttach(dJointCreateContact(id_, joints_, &contact), dGeomGetBody(o1), dGeomGetBody(o2));
    }
    contacts += count;
    most_of_a_pair = std::max(most_of_a_pair, count);
  }

  dWorldID id_;
  dSpaceID space_;
  dJointGroupID joints_;
  double step_ = 0;  // s
};

/// The angular momentum R I R^T w about the body's centre of mass, world frame, kg m^2/s.
inline Vec spin_momentum(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const dReal* const w = dBodyGetAngularVel(body);
  dVector3 spin;
  dBodyVectorFromWorld(body, w[0], w[1], w[2], spin);
  dVector3 momentum;
  dMultiply0_331(momentum, mass.I, spin);
  dVector3 world;
  dBodyVectorToWorld(body, momentum[0], momentum[1], momentum[2], world);
  return to_vec(world);
}

inline double mass_of(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return mass.mass;
}

/// The kinetic energy, J.
inline double kinetic_energy(dBodyID body) {
  const Vec v = to_vec(dBodyGetLinearVel(body));
  return 0.5 * (mass_of(body) * dot(v, v) + dot(to_vec(dBodyGetAngularVel(body)), spin_momentum(body)));
}

/// The kinetic energy, plus the potential energy of gravity from z = 0; J.
inline double energy(dBodyID body) { return kinetic_energy(body) + mass_of(body) * kGravity * dBodyGetPosition(body)[2]; }

inline void set_position(dBodyID body, const Vec& p) { dBodySetPosition(body, dReal(p[0]), dReal(p[1]), dReal(p[2])); }
inline void set_gravity(const World& world, const Vec& g) { dWorldSetGravity(world.id(), dReal(g[0]), dReal(g[1]), dReal(g[2])); }

/// Sets the orientation to a rotation by an angle (rad) about an axis.
inline void turn(dBodyID body, const Vec& axis, double angle) {
  dMatrix3 R;
  dRFromAxisAndAngle(R, dReal(axis[0]), dReal(axis[1]), dReal(axis[2]), dReal(angle));
  dBodySetRotation(body, R);
}

}  // namespace supernormal::test
