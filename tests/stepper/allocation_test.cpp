// Tests that the stepper does not allocate. counted_allocations.cpp replaces operator new for everything in this executable.
#include <doctest/doctest.h>

#include "stepper/stepper_world.hpp"
#include "support/counted_allocations.hpp"

using namespace supernormal::test;

TEST_CASE("once warm, no step allocates") {
  StepperWorld scene(0.01, dSimpleSpaceCreate);  // ODE's hash space allocates
  scene.surface.mode |= dContactRolling | dContactBounce;
  scene.surface.mu = dReal(0.5);
  scene.surface.rho = dReal(1e-4);
  scene.surface.bounce = dReal(0.3);
  scene.world.add_plane();
  for (int i = 0; i < 6; ++i) {
    const dBodyID below = scene.add_brick(i % 2 == 0 ? 8 : 2, 1000, {0.3 * i, 0, 0.06});
    const dBodyID above = scene.add_brick(i % 2 == 0 ? 8 : 2, 1000, {0.3 * i, 0, 0.18});
    if (i < 3) continue;
    const dJointID hinge = dJointCreateHinge(scene.world.id(), nullptr);
    dJointAttach(hinge, above, below);
    dJointSetHingeAnchor(hinge, dReal(0.3 * i), 0, dReal(0.12));
  }
  scene.run(0.3);
  const long before = allocations();
  scene.run(0.3);
  CHECK(allocations() == before);
  CHECK(scene.contacts > 12);
}
