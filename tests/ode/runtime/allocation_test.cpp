// Tests that neither colliders nor the stepper allocate. counted_allocations.cpp replaces operator new for everything in this
// executable.
#include <doctest/doctest.h>

#include <array>
#include <span>
#include <vector>

#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"
#include "stepper/stepper_world.hpp"
#include "supernormal/effects.hpp"
#include "support/counted_allocations.hpp"
#include "support/ode_world.hpp"

using namespace supernormal::test;

TEST_CASE_FIXTURE(OdeSession, "after the first call no collider, bounding box or query allocates") {
  {
    const long before = allocations();
    const Geom counted(snCreateEllipsoid(nullptr, 1, 1, 1));
    REQUIRE(allocations() > before);  // the counter counts the library's allocations
    const Geom beside(snCreateEllipsoid(nullptr, 1, 1, dReal(0.9)));
    for (int i = 0; i < 2; ++i) collide(counted, beside);
    CHECK(statistics().queries_warm == 1);  // in a new program queries start from the last normals
  }
  Random random(26);
  std::vector<Geom> bodies;
  for (int i = 0; i < 40; ++i) {
    bodies.emplace_back(i % 2 == 0 ? random_body(random)
                                   : snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.5), i % 3 == 0 ? 20 : dReal(1.3), 8));
    if (i % 5 == 0) snGeomSetRounding(bodies.back(), dReal(0.1));
    place(bodies.back(), random.uniform(0, 4) * random.direction());
  }
  std::vector<ColliderGeom> colliders;
  colliders.reserve(kColliderKinds.size());
  for (const ColliderKind kind : kColliderKinds) colliders.emplace_back(kind, random);
  const ConvexGeom crowded(std::vector<Vec>(2000, Vec{0.5, 0.5, 0.5}));
  const MeshGeom mesh(box_mesh({2, 2.5, 1.5}));
  const Terrain terrain({}, [](int i, int j) { return 0.3 * ((3 * i + 5 * j) % 4); });
  const Geom hills(terrain.create(true));

  long contacts_seen = 0;
  const auto everything = [&] {
    std::array<dContactGeom, 8> contacts;
    snProximity answer;
    dReal aabb[6];
    for (const Geom& g1 : bodies) {
      for (const Geom& g2 : bodies) {
        contacts_seen += dCollide(g1, g2, 8, contacts.data(), sizeof contacts[0]);
        if (dGeomID(g1) != dGeomID(g2)) snGeomProximity(g1, g2, &answer);
      }
      for (const ColliderGeom& collider : colliders) {
        contacts_seen += dCollide(g1, collider, 8, contacts.data(), sizeof contacts[0]);
        snGeomProximity(g1, collider, &answer);
      }
      contacts_seen += dCollide(g1, crowded, 8, contacts.data(), sizeof contacts[0]);
      contacts_seen += dCollide(g1, mesh, 8, contacts.data(), sizeof contacts[0]);
      snGeomProximity(g1, mesh, &answer);
      contacts_seen += dCollide(g1, hills, 8, contacts.data(), sizeof contacts[0]);
      snGeomProximity(g1, hills, &answer);
      snGeomPointDepth(g1, 1, 2, 3);
      dGeomMoved(g1);
      dGeomGetAABB(g1, aabb);
    }
  };
  everything();
  for (const int warm_start : {1, 0}) {
    snSetWarmStart(warm_start);
    for (const Geom& body : bodies) move(body, 0.01 * random.direction());
    const long before = allocations();
    everything();
    CHECK(allocations() == before);
  }
  CHECK(contacts_seen > 1000);
}

TEST_CASE_FIXTURE(OdeSession, "after the first batch no batch allocates") {
  Random random(27);
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  std::vector<dGeomID> bodies;
  for (int i = 0; i < 60; ++i) {
    bodies.push_back(random_body(random, space));
    place(bodies.back(), random.uniform(0, 4) * random.direction());
  }
  dCreatePlane(space, 0, 0, 1, -1);
  const snBatchID batch = snBatchCreate(1);  // with several threads, one might start too late for the warm-up
  int contacts_seen = 0;
  const auto collide_all = [&] {
    const auto count = [](void* seen, dGeomID, dGeomID, const dContactGeom*, int more) { *static_cast<int*>(seen) += more; };
    snBatchCollide(batch, space, 8, &contacts_seen, nullptr, count);
  };
  collide_all();
  for (const dGeomID body : bodies)
    place(body, 1.001 * to_vec(dGeomGetPosition(body)));  // farther apart, so there are no more pairs than before
  const long before = allocations();
  collide_all();
  CHECK(allocations() == before);
  CHECK(contacts_seen > 500);
  snBatchDestroy(batch);
  dSpaceDestroy(space);
}

TEST_CASE("effects set up contacts and add forces without allocation") {
  namespace fx = supernormal::effects;
  OdeSession session;
  const World world;
  fx::Effects effects(
      {fx::Gravity{{0, 0, -9.81}}, fx::Friction{0.5, {}}, fx::RollingResistance{1e-3, 1e-3, {}}, fx::Hertz{1e7, 0.3, 0.8, {}},
       fx::Adhesion{1, {}}, fx::QuadraticDrag{1.2, 0.5}, fx::StokesDrag{1e-3}, fx::Buoyancy{1000, 0}},
      1e-3);
  effects.set_up(world.id());
  const dBodyID body = dBodyCreate(world.id());
  const Geom puck(snCreateSuperellipsoid(nullptr, 1, 1, dReal(0.2), 20, 20));
  dGeomSetBody(puck, body);
  effects.add_body(body);
  dBodySetLinearVel(body, 1, 0, 0);
  const Geom floor(dCreatePlane(nullptr, 0, 0, 1, dReal(-0.199)));
  std::array<dContact, 8> contacts{};
  const int count = dCollide(puck, floor, 8, &contacts[0].geom, sizeof(dContact));
  REQUIRE(count > 1);
  const long before = allocations();
  for (int i = 0; i < 3; ++i) {
    CHECK(effects.set_up_contacts(std::span(contacts).first(static_cast<std::size_t>(count))) == count);
    effects.apply_forces();
  }
  CHECK(allocations() == before);
}

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
