// A world of falling bodies, set up as in a first program with ODE.
#pragma once

#include "common/ode_world.hpp"

namespace resting {

/// ODE's defaults, gravity along -z, auto-disable, and Coulomb friction of 0.5 between all surfaces.
class World {
 public:
  /// `space` is destroyed with the world. `step`: s. `room`: max_contacts, 1 to 8. With `looks_ahead` the bodies of Supernormal
  /// have contacts before they overlap.
  World(dSpaceID space, double step, int room, bool looks_ahead);

  dWorldID id() const { return world_.id(); }
  dSpaceID space() const { return world_.space(); }

  /// Adds a body of this mass with the geom, which must be in the space.
  dBodyID add(dGeomID geom, const dMass& mass);

  /// Makes a step. `number` seeds quickstep's order of rows, so a run repeats.
  void step(int number);

 private:
  void add_contacts(dGeomID o1, dGeomID o2);

  common::OdeWorld world_;
  double step_;
  int room_;
  bool looks_ahead_;
};

}  // namespace resting
