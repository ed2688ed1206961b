#include "common/ode_world.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

TEST_CASE("ODE's world: a body of ours has its mass, and rests by the contacts that are joined") {
  dInitODE2(0);
  {
    common::OdeWorld world(dSimpleSpaceCreate(nullptr));
    dWorldSetGravity(world.id(), 0, 0, -10);
    dCreatePlane(world.space(), 0, 0, 1, 0);
    const dBodyID body = world.add(snCreateSuperellipsoid(world.space(), 0.1, 0.1, 0.1, 8, 8), 1000.0);
    dMass mass;
    dBodyGetMass(body, &mass);
    CHECK(mass.mass == doctest::Approx(8).epsilon(0.1));  // a cube of 0.2 m without its edges
    dBodySetPosition(body, 0, 0, dReal(0.11));
    for (int i = 0; i < 200; ++i) {
      world.collide([&](dGeomID geom1, dGeomID geom2) {
        dContact contacts[4];
        const int count = dCollide(geom1, geom2, 4, &contacts[0].geom, sizeof(dContact));
        for (int k = 0; k < count; ++k) {
          contacts[k].surface.mode = 0;
          contacts[k].surface.mu = dInfinity;
          world.join(contacts[k]);
        }
      });
      world.step(0.01);
    }
    CHECK(dBodyGetPosition(body)[2] == doctest::Approx(0.1).epsilon(0.01));
    CHECK(dBodyGetNumJoints(body) == 0);  // a step ends its contacts
    CHECK_THROWS_AS(world.add(nullptr, 1000.0), std::runtime_error);
  }
  dCloseODE();
}
