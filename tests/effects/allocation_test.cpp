// Tests that impacts do not allocate. counted_allocations.cpp replaces operator new for everything in this executable.
#include <doctest/doctest.h>

#include "effects/effects_world.hpp"
#include "support/counted_allocations.hpp"

using namespace supernormal::test;

TEST_CASE("speculative contacts: once warm, impacts do not allocate") {
  OdeSession session;
  EffectsWorld scene({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 20e-3,
                     dSimpleSpaceCreate(nullptr));  // a hash space allocates
  for (const dReal side : {dReal(1), dReal(-1)}) {
    for (int axis = 0; axis < 3; ++axis)
      dCreatePlane(scene.world.space(), axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0, dReal(-0.1));
  }
  dBodyID brick = nullptr;
  for (int k = 0; k < 4; ++k) {
    brick = scene.add_body({0.02, 0.02, 0.02}, 8, kDensity, {k % 2 == 0 ? 0.04 : -0.04, k < 2 ? 0.04 : -0.04, 0});
    throw_body(brick, {k < 2 ? 1.0 : -1.0, k % 2 == 0 ? 2.0 : -1.0, 3});
    dBodySetGyroscopicMode(brick, 0);
  }
  scene.run_until(10);
  const long before = allocations();
  int bounces = 0;
  for (int k = 0; k < 500; ++k) {
    const dReal velocity = dBodyGetLinearVel(brick)[2];
    scene.step();
    if (dBodyGetLinearVel(brick)[2] * velocity < 0) ++bounces;
  }
  CHECK(allocations() - before < 5);  // a step with more impacts than all before lets a buffer grow
  CHECK(bounces > 100);
}
