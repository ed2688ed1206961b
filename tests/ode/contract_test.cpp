// What dCollide promises: order, normal, depth, skip, flags, fields.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "ode/ode_fixture.hpp"

using namespace supernormal::test;

namespace {

enum class PartnerKind { Body, Plane, Sphere };

// A partner that overlaps a body at the origin (half-axes 0.5…1.5) or stays just clear of it.
dGeomID make_partner(PartnerKind kind, Random& random) {
  const Vec n = random.direction();
  const double distance = random.uniform(0.6, 1.8);
  if (kind == PartnerKind::Plane) {
    return dCreatePlane(nullptr, dReal(n[0]), dReal(n[1]), dReal(n[2]), dReal(-random.uniform(0.2, 1.5)));
  }
  const dGeomID geom = kind == PartnerKind::Body ? random_body(random) : dCreateSphere(nullptr, dReal(random.uniform(0.3, 1)));
  place(geom, distance * n);
  return geom;
}

// Takes the unit normal into g1 and a depth at their word.
void check_contact(const dContactGeom& contact, dGeomID g1, dGeomID g2) {
  CHECK(contact.g1 == g1);
  CHECK(contact.g2 == g2);
  CHECK(contact.side1 == -1);
  CHECK(contact.side2 == -1);
  CHECK(norm(to_vec(contact.normal)) == doctest::Approx(1).epsilon(1e-14));
  CHECK(contact.depth >= 0);
  CHECK(std::isfinite(norm(to_vec(contact.pos))));
}

}  // namespace

TEST_CASE("a contact moves the geoms apart, and nothing less does") {
  OdeSession session;
  Random random(1);
  for (const PartnerKind kind : {PartnerKind::Body, PartnerKind::Plane, PartnerKind::Sphere}) {
    CAPTURE(static_cast<int>(kind));
    int overlapping = 0;
    for (int i = 0; i < 300; ++i) {
      CAPTURE(i);
      const Geom body(random_body(random));
      const Geom partner(make_partner(kind, random));
      for (const bool ours_first : {true, false}) {
        CAPTURE(ours_first);
        const dGeomID g1 = ours_first ? body : partner;
        const dGeomID g2 = ours_first ? partner : body;
        const auto contacts = collide(g1, g2);
        if (contacts.empty()) continue;
        ++overlapping;
        REQUIRE(contacts.size() == 1);
        check_contact(contacts[0], g1, g2);

        // Move our body: along the normal when it is g1, against it otherwise.
        const double sign = ours_first ? 1 : -1;
        const Vec out = sign * double{contacts[0].depth} * to_vec(contacts[0].normal);
        const Vec start = to_vec(dGeomGetPosition(body));
        place(body, start + 0.96 * out);
        CHECK(collide(g1, g2).size() == 1);
        place(body, start + (1 + 1e-6) * out);
        CHECK(collide(g1, g2).empty());
        place(body, start);
      }
    }
    CHECK(overlapping > 200);
  }
}

TEST_CASE("both call orders give the same contact, turned around") {
  OdeSession session;
  Random random(2);
  for (const bool warm_start : {true, false}) {
    snSetWarmStart(warm_start ? 1 : 0);
    for (const PartnerKind kind : {PartnerKind::Body, PartnerKind::Plane, PartnerKind::Sphere}) {
      for (int i = 0; i < 100; ++i) {
        const Geom body(random_body(random));
        const Geom partner(make_partner(kind, random));
        collide(body, partner);  // so that both of the following find the same remembered normal
        collide(body, partner);
        const auto forth = collide(body, partner);
        const auto back = collide(partner, body);
        REQUIRE(forth.size() == back.size());
        if (forth.empty()) continue;
        CHECK(forth[0].g1 == back[0].g2);
        CHECK(forth[0].g2 == back[0].g1);
        CHECK(norm(to_vec(forth[0].normal) + to_vec(back[0].normal)) <= 1e-6);
        CHECK(forth[0].depth == doctest::Approx(back[0].depth).epsilon(1e-8));
        if (warm_start) continue;
        for (int axis = 0; axis < 3; ++axis) {  // a pure function of the poses: to the last bit
          CHECK(forth[0].normal[axis] == -back[0].normal[axis]);
          CHECK(forth[0].pos[axis] == back[0].pos[axis]);
        }
        CHECK(forth[0].depth == back[0].depth);
      }
    }
  }
}

TEST_CASE("skip and flags: nothing is written beside the contacts asked for") {
  OdeSession session;
  const Geom body(snCreateSuperellipsoid(nullptr, 1, 1, 1, 4, 4));
  const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  const Geom sphere(dCreateSphere(nullptr, 1));
  dGeomSetPosition(other, dReal(1.7), 0, 0);
  dGeomSetPosition(sphere, 0, dReal(1.7), 0);

  constexpr unsigned char kUntouched = 0xA5;
  constexpr int kSlots = 4;
  for (const dGeomID partner : {dGeomID(other), dGeomID(plane), dGeomID(sphere)}) {
    for (const std::size_t skip : {sizeof(dContactGeom), sizeof(dContact), sizeof(dContactGeom) + 40}) {
      for (const unsigned flags : {1U, 4U, 0x00070001U, 0x80000001U, 0x80000004U, 0xffffU}) {
        std::vector<unsigned char> memory(kSlots * skip, kUntouched);
        auto* const contacts = reinterpret_cast<dContactGeom*>(memory.data());
        const int count = dCollide(body, partner, static_cast<int>(flags), contacts, static_cast<int>(skip));
        REQUIRE(count == 1);
        check_contact(contacts[0], body, partner);
        for (std::size_t i = sizeof(dContactGeom); i < memory.size(); ++i) REQUIRE(memory[i] == kUntouched);
      }
    }
  }
}

TEST_CASE("the array is not touched when the geoms are apart") {
  OdeSession session;
  const Geom body(snCreateEllipsoid(nullptr, 1, 2, 3));
  const Geom other(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, -4));
  const Geom sphere(dCreateSphere(nullptr, 1));
  dGeomSetPosition(other, dReal(2.1), 0, 0);
  dGeomSetPosition(sphere, 0, dReal(3.1), 0);
  for (const dGeomID partner : {dGeomID(other), dGeomID(plane), dGeomID(sphere)}) {
    std::vector<unsigned char> memory(sizeof(dContactGeom), 0x5A);
    const auto before = memory;
    CHECK(dCollide(body, partner, 1, reinterpret_cast<dContactGeom*>(memory.data()), sizeof(dContactGeom)) == 0);
    CHECK(memory == before);
  }
}

TEST_CASE("geoms of one body do not collide; a body with itself neither") {
  OdeSession session;
  const dWorldID world = dWorldCreate();
  const dBodyID body = dBodyCreate(world);
  {
    const Geom one(snCreateEllipsoid(nullptr, 1, 1, 1));
    const Geom two(snCreateEllipsoid(nullptr, 1, 1, 1));
    dGeomSetBody(one, body);
    CHECK(collide(one, two).size() == 1);
    CHECK(collide(one, one).empty());
    dGeomSetBody(two, body);
    CHECK(collide(one, two).empty());
  }
  dWorldDestroy(world);
}

TEST_CASE("a body whose pose is not a number gives no contact and does not stop a space") {
  OdeSession session;
  const dSpaceID space = dHashSpaceCreate(nullptr);
  const dGeomID broken = snCreateEllipsoid(space, 1, 1, 1);
  const dGeomID other = snCreateSuperellipsoid(space, 1, 1, 1, 3, 3);
  const dGeomID plane = dCreatePlane(space, 0, 0, 1, 0);
  const dGeomID sphere = dCreateSphere(space, 1);
  const dReal nan = std::numeric_limits<dReal>::quiet_NaN();
  dGeomSetPosition(broken, nan, nan, nan);
  for (const dGeomID partner : {other, plane, sphere}) {
    CHECK(collide(broken, partner).empty());
    CHECK(collide(partner, broken).empty());
  }
  int pairs = 0;
  dSpaceCollide(space, &pairs, [](void* count, dGeomID, dGeomID) { ++*static_cast<int*>(count); });
  CHECK(pairs > 0);
  dSpaceDestroy(space);
}
