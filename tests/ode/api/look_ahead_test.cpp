// Tests of the functions for contacts before overlap: their refusals and their effects.
#include <doctest/doctest.h>

#include "ode/mesh_fixture.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

constexpr dReal kNoTime = std::numeric_limits<dReal>::quiet_NaN();
constexpr dReal kEternity = std::numeric_limits<dReal>::infinity();

dContact contact_of_depth(dReal depth) {
  dContact contact{};
  contact.geom.depth = depth;
  contact.surface.mode = dContactApprox1;
  contact.surface.mu = dReal(0.5);
  return contact;
}

Vec size_of_box(dGeomID geom) {
  dReal aabb[6];
  dGeomGetAABB(geom, aabb);
  return {double{aabb[1]} - aabb[0], double{aabb[3]} - aabb[2], double{aabb[5]} - aabb[4]};
}

}  // namespace

TEST_CASE("an invalid look-ahead time is refused, with its value and the range, and changes nothing") {
  OdeSession session;
  const Geom geom(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Vec before = size_of_box(geom);
  for (const dReal time : {dReal(-1), kNoTime, kEternity, dReal(2e6)}) {
    CHECK(refused(snGeomSetLookAhead(geom, time), "snGeomSetLookAhead: time = "));
    CHECK(refused_with("is outside [0, 1e+06] s"));
    CHECK(refused(snSetDefaultLookAhead(time), "snSetDefaultLookAhead: time = "));
  }
  CHECK(size_of_box(geom) == before);
  const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
  CHECK(size_of_box(other) == before);
  const Geom sphere(dCreateSphere(nullptr, 1));
  CHECK(refused(snGeomSetLookAhead(sphere, dReal(0.01)), "a dSphere"));
  CHECK(snGeomSetLookAhead(nullptr, dReal(0.01)) == 0);
}

TEST_CASE("snContactLookAhead lets a gap close within the step, and does not change other contacts") {
  dContact contact = contact_of_depth(dReal(-0.5));
  snContactLookAhead(&contact, dReal(0.25));
  CHECK(contact.geom.depth == 0);
  CHECK(contact.surface.mode == (dContactApprox1 | dContactMotionN));
  CHECK(contact.surface.motionN == -2);
  // A surface that moves out already, like a piston.
  contact = contact_of_depth(dReal(-0.5));
  contact.surface.mode |= dContactMotionN;
  contact.surface.motionN = 3;
  snContactLookAhead(&contact, dReal(0.25));
  CHECK(contact.surface.motionN == 1);
  for (const dReal depth : {dReal(0), dReal(0.1)}) {
    contact = contact_of_depth(depth);
    snContactLookAhead(&contact, dReal(0.25));
    CHECK(contact.geom.depth == depth);
    CHECK(contact.surface.mode == dContactApprox1);
  }
  for (const dReal step : {dReal(0), dReal(-1), kNoTime, kEternity}) {
    contact = contact_of_depth(dReal(-0.5));
    snContactLookAhead(&contact, step);
    CHECK(refused_with("snContactLookAhead: step = "));
    CHECK(contact.geom.depth == dReal(-0.5));
    CHECK(contact.surface.mode == dContactApprox1);
  }
  // So short that ODE would get a number that is not finite.
  for (const dReal depth : {dReal(-10), -kEternity}) {
    contact = contact_of_depth(depth);
    snContactLookAhead(&contact, std::numeric_limits<dReal>::min());
    CHECK(refused_with("snContactLookAhead: step = "));
    CHECK(refused_with("but motionN must be within"));
    CHECK(contact.geom.depth == depth);
    CHECK(contact.surface.mode == dContactApprox1);
  }
  snContactLookAhead(nullptr, dReal(0.01));
  CHECK(refused_with("snContactLookAhead: contact = NULL"));
}

TEST_CASE(
    "geoms that look ahead lose four fifths of an overlap in a step, others and contacts with an ERP of their own as before") {
  struct Case {
    double time;  // s
    dReal soft_erp;
    double left;  // of the overlap, after a step
  };
  const double step = 0.01;
  for (const Case& c : {Case{step, 0, 0.2}, Case{0, 0, 0.8}, Case{step, dReal(0.5), 0.5}}) {
    OdeSession session;
    World world;
    dWorldSetGravity(world.id(), 0, 0, 0);
    world.add_plane();
    if (c.soft_erp > 0) world.surface.mode = dContactSoftERP;
    world.surface.soft_erp = c.soft_erp;
    const dGeomID geom = snCreateEllipsoid(world.space(), dReal(0.1), dReal(0.1), dReal(0.1));
    const dBodyID body = world.add(geom, 1000);
    dBodySetPosition(body, 0, 0, dReal(0.099));
    REQUIRE(snGeomSetLookAhead(geom, dReal(c.time)) == 1);
    world.quick_step(step);
    CHECK(0.1 - double{dBodyGetPosition(body)[2]} == relative(0.001 * c.left).epsilon(1e-3));
  }
}

TEST_CASE("the bounding box covers the motion within the look-ahead time, and only the body without it") {
  OdeSession session;
  World world;
  dWorldSetGravity(world.id(), 0, 0, 0);
  const dGeomID geom = snCreateEllipsoid(world.space(), 1, 1, 1);
  const dBodyID body = world.add(geom, 1000);
  const Vec still = size_of_box(geom);
  dBodySetLinearVel(body, 100, 0, 0);
  REQUIRE(snGeomSetLookAhead(geom, dReal(0.1)) == 1);
  CHECK(size_of_box(geom)[0] == doctest::Approx(12.02));  // with one hundredth of the half-extent on both sides
  CHECK(size_of_box(geom)[1] == doctest::Approx(2.02));
  // ODE keeps the box until dGeomMoved or a move.
  dBodySetLinearVel(body, 0, 200, 0);
  CHECK(size_of_box(geom)[1] == doctest::Approx(2.02));
  dGeomMoved(geom);
  CHECK(size_of_box(geom)[1] == doctest::Approx(22.02));
  dBodySetLinearVel(body, 0, 0, 0);
  dBodySetAngularVel(body, 0, 0, 1);
  dGeomMoved(geom);
  CHECK(size_of_box(geom)[1] > 2.2);
  dBodySetAngularVel(body, 0, 0, 1000);  // at most to the other side
  dGeomMoved(geom);
  CHECK(size_of_box(geom)[1] < 14);
  REQUIRE(snGeomSetLookAhead(geom, 0) == 1);
  CHECK(size_of_box(geom) == still);
}

TEST_CASE("without look-ahead no contact has a negative depth, and the contacts have the same bits as before") {
  OdeSession session;
  Random random(11);
  const Geom floor(dCreatePlane(nullptr, 0, 0, 1, 0));
  const Geom box(dCreateBox(nullptr, 2, 2, 2));
  place(box, {0, 0, -1});
  const Geom brick(snCreateSuperellipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3), 20, 20));
  const Geom other(snCreateSuperellipsoid(nullptr, 1, 1, 1, 8, 8));
  place(other, {0, 0, -1});
  snSetWarmStart(0);
  int with_contacts = 0;
  for (int k = 0; k < 300; ++k) {
    random.turn(brick);
    place(brick, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.2, 0.6)});
    for (const dGeomID collider : {dGeomID(floor), dGeomID(box), dGeomID(other)}) {
      const std::vector<dContactGeom> plain = collide(brick, collider);
      for (const dContactGeom& contact : plain) CHECK(contact.depth >= 0);
      REQUIRE(snGeomSetLookAhead(brick, dReal(0.01)) == 1);
      const std::vector<dContactGeom> ahead = collide(brick, collider);
      if (!plain.empty()) CHECK(ahead.size() >= 1);  // never fewer than without look-ahead
      with_contacts += ahead.empty() ? 0 : 1;
      REQUIRE(snGeomSetLookAhead(brick, 0) == 1);
      CHECK(same_bits(collide(brick, collider), plain));
    }
  }
  CHECK(with_contacts > 300);
}

TEST_CASE("a geom that looks ahead with a velocity that is not finite has no contacts, and the error names the velocity") {
  OdeSession session;
  World world;
  const dGeomID ours = snCreateSuperellipsoid(world.space(), 1, 1, 1, 8, 8);
  const dBodyID body = world.add(ours, 1000);
  REQUIRE(snGeomSetLookAhead(ours, dReal(0.01)) == 1);
  dBodySetPosition(body, 2, 2, dReal(0.9));
  const MeshGeom mesh(floor_arrays(4, 4, 1));
  const Geom box(dCreateBox(nullptr, 9, 9, dReal(0.01))), plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  for (const dGeomID other : {dGeomID(mesh), dGeomID(box), dGeomID(plane)}) {
    dBodySetLinearVel(body, 0, 0, 0);
    CHECK(!collide(ours, other).empty());
    for (const dReal bad : {kNoTime, kEternity, -kEternity}) {
      dBodySetLinearVel(body, 0, bad, 0);
      CHECK(collide(ours, other).empty());
      CHECK(refused_with("dCollide: velocity of the body of a geom of this library's class = "));
    }
  }
}
