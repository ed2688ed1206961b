// Tests that impacts do not allocate. counted_allocations.cpp replaces operator new for everything in this executable.
#include <doctest/doctest.h>

#include "effects/effects_world.hpp"
#include "support/counted_allocations.hpp"

using namespace supernormal::test;

TEST_CASE("speculative contacts: once warm, impacts do not allocate") {
  OdeSession session;
  World world(dSimpleSpaceCreate(nullptr));  // ODE's hash space allocates
  set_gravity(world, {0, 0, 0});
  fx::Effects effects({fx::Restitution{1, 0, {}}, fx::SpeculativeContacts{}}, 20e-3);
  for (const double side : {1.0, -1.0}) {
    for (const Vec& n : {Vec{side, 0, 0}, Vec{0, side, 0}, Vec{0, 0, side}})
      dCreatePlane(world.space(), dReal(n[0]), dReal(n[1]), dReal(n[2]), dReal(-0.1));
  }
  std::array<dBodyID, 4> bricks{};
  for (std::size_t k = 0; k < bricks.size(); ++k) {
    const auto size = dReal(0.02);
    bricks[k] = world.add(snCreateSuperellipsoid(world.space(), size, size, size, 8, 8), kDensity);
    set_position(bricks[k], {k % 2 == 0 ? 0.04 : -0.04, k < 2 ? 0.04 : -0.04, 0});
    dBodySetLinearVel(bricks[k], k < 2 ? 1 : -1, k % 2 == 0 ? 2 : -1, 3);
    dBodySetGyroscopicMode(bricks[k], 0);
    effects.add_body(bricks[k]);
  }
  struct Run {
    fx::Effects& effects;
    dWorldID world;
    dJointGroupID joints;
  } run{effects, world.id(), dJointGroupCreate(0)};
  long warm = 0;
  int changes = 0;
  for (int step = 0; step < 1000; ++step) {
    if (step == 500) warm = allocations();
    dSpaceCollide(world.space(), &run, [](void* data, dGeomID o1, dGeomID o2) {
      const Run& in = *static_cast<const Run*>(data);
      std::array<dContact, World::kRoom> contacts{};
      const int count = dCollide(o1, o2, World::kRoom, &contacts[0].geom, sizeof(dContact));
      const int kept = in.effects.set_up_contacts(std::span(contacts).first(static_cast<std::size_t>(count)));
      for (int k = 0; k < kept; ++k)
        dJointAttach(dJointCreateContact(in.world, in.joints, &contacts[static_cast<std::size_t>(k)]), dGeomGetBody(o1),
                     dGeomGetBody(o2));
    });
    effects.apply_forces();
    const double before = dBodyGetLinearVel(bricks[0])[2];
    dWorldQuickStep(world.id(), dReal(20e-3));
    dJointGroupEmpty(run.joints);
    if (step >= 500 && dBodyGetLinearVel(bricks[0])[2] * before < 0) ++changes;
  }
  CHECK(allocations() - warm < 5);  // a step with more impacts than all before lets a buffer grow
  CHECK(changes > 100);
  dJointGroupDestroy(run.joints);
}
