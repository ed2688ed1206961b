// A world of falling bodies, set up as in a first program with ODE.
#pragma once

#include <array>

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

  /// Adds a superellipsoid with this exponent in both sections, or a dBox if it is 0. Half-axes in m. Throws std::runtime_error.
  dBodyID add(double exponent, const std::array<double, 3>& half_axes);

  /// Adds a body of this mass with the geom, which must be in the space.
  dBodyID add(dGeomID geom, const dMass& mass);

  /// Makes a step. `number` seeds quickstep's order of rows, so a run repeats.
  void step(int number);

  /// m; the depth of the deepest contact in the last step.
  double overlap() const { return overlap_; }

 private:
  void add_contacts(dGeomID o1, dGeomID o2);

  common::OdeWorld world_;
  double step_;
  int room_;
  bool looks_ahead_;
  double overlap_ = 0;
};

}  // namespace resting
