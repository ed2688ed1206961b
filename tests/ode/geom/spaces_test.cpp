// Tests that the same geoms collide in every kind of space, inside a dGeomTransform, and with an offset.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ode/collider_fixture.hpp"
#include "support/ode_fixture.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

// dGeomTransform is deprecated in favour of geom offsets, but programs use it and we promise to work inside it.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

using namespace supernormal::test;

namespace {

struct SpaceKind {
  std::string name;
  std::function<dSpaceID()> create;
};

std::vector<SpaceKind> space_kinds() {
  std::vector<SpaceKind> kinds = {{"simple", [] { return dSimpleSpaceCreate(nullptr); }},
                                  {"hash", [] { return dHashSpaceCreate(nullptr); }},
                                  {"quadtree", [] {
                                     const dVector3 centre = {0, 0, 0};
                                     const dVector3 extents = {20, 20, 20};
                                     return dQuadTreeSpaceCreate(nullptr, centre, extents, 5);
                                   }}};
  const std::vector<std::pair<std::string, int>> orders = {{"XYZ", dSAP_AXES_XYZ}, {"XZY", dSAP_AXES_XZY}, {"YXZ", dSAP_AXES_YXZ},
                                                           {"YZX", dSAP_AXES_YZX}, {"ZXY", dSAP_AXES_ZXY}, {"ZYX", dSAP_AXES_ZYX}};
  for (const auto& [name, order] : orders) {
    kinds.push_back({"SAP " + name, [axes = order] { return dSweepAndPruneSpaceCreate(nullptr, axes); }});
  }
  return kinds;
}

using Pairs = std::set<std::pair<dGeomID, dGeomID>>;  // smaller address first

struct Found {
  Pairs near_pairs, touching;
};

// Pairs of ODE's own geoms are ignored.
bool is_one_ours(dGeomID o1, dGeomID o2) { return dGeomGetClass(o1) == snGeomClass() || dGeomGetClass(o2) == snGeomClass(); }

void find_pair(void* data, dGeomID o1, dGeomID o2) {
  if (!is_one_ours(o1, o2)) return;
  auto& found = *static_cast<Found*>(data);
  const auto pair = std::minmax(o1, o2);
  found.near_pairs.insert(pair);
  if (!collide(o1, o2).empty()) found.touching.insert(pair);
}

// 60 crowded bodies, five of each of ODE's geoms and two planes. Destroy it before the space.
struct SpaceCrowd {
  std::vector<ColliderGeom> colliders;
  std::vector<dGeomID> geoms;

  explicit SpaceCrowd(dSpaceID space) {
    Random random(3);
    for (int i = 0; i < 60; ++i) geoms.push_back(random_body(random, space));
    for (const ColliderKind kind : kSolidKinds) {
      for (int i = 0; i < 5; ++i) geoms.push_back(colliders.emplace_back(kind, random, space));
    }
    for (const dGeomID geom : geoms) place(geom, {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)});
    geoms.push_back(dCreatePlane(space, 0, 0, 1, -4));
    geoms.push_back(dCreatePlane(space, dReal(0.6), dReal(0.48), dReal(0.64), -5));
  }
};

Pairs touching_without_space(const std::vector<dGeomID>& geoms) {
  Pairs touching;
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    for (std::size_t j = i + 1; j < geoms.size(); ++j) {
      if (is_one_ours(geoms[i], geoms[j]) && !collide(geoms[i], geoms[j]).empty()) touching.insert(std::minmax(geoms[i], geoms[j]));
    }
  }
  return touching;
}

// Puts `inner` into the transform, both anywhere near the origin. Puts `direct`, the same geom again, where `inner` then is.
void wrap(dGeomID transform, dGeomID inner, dGeomID direct, Random& random) {
  random.turn(inner);
  place(inner, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
  random.turn(transform);
  place(transform, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.5, 1.5)});
  dGeomTransformSetGeom(transform, inner);

  const dReal* const R1 = dGeomGetRotation(transform);
  dMatrix3 R;
  dMultiply0(R, R1, dGeomGetRotation(inner), 3, 3, 3);
  dVector3 p;
  dMultiply0(p, R1, dGeomGetPosition(inner), 3, 3, 1);
  dGeomSetRotation(direct, R);
  place(direct, to_vec(p) + to_vec(dGeomGetPosition(transform)));
}

// Returns the number of contacts.
int check_same_contacts(dGeomID transform, dGeomID direct, dGeomID other) {
  const auto by_transform = collide(transform, other);
  const auto by_hand = collide(direct, other);
  REQUIRE(by_transform.size() == by_hand.size());
  if (by_hand.empty()) return 0;
  CHECK(by_transform[0].depth == relative(by_hand[0].depth).epsilon(1e-9));
  CHECK(norm(to_vec(by_transform[0].normal) - to_vec(by_hand[0].normal)) < 1e-5);
  CHECK(norm(to_vec(by_transform[0].pos) - to_vec(by_hand[0].pos)) < 1e-5);
  return 1;
}

struct Box {
  std::array<dReal, 6> side{};
  explicit Box(dGeomID geom) { dGeomGetAABB(geom, side.data()); }
};

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "every space finds exactly the touching pairs") {
  for (const SpaceKind& kind : space_kinds()) {
    CAPTURE(kind.name);
    const dSpaceID space = kind.create();
    {
      const SpaceCrowd crowd(space);
      const Pairs expected = touching_without_space(crowd.geoms);
      REQUIRE(expected.size() > 60);
      Found found;
      dSpaceCollide(space, &found, find_pair);
      CHECK(found.touching == expected);
    }
    dSpaceDestroy(space);
  }
}

TEST_CASE_FIXTURE(OdeSession, "a plane that no body touches causes no near callback") {
  const std::vector<std::array<dReal, 4>> planes = {
      {0, 0, 1, -8}, {1, 0, 0, -8}, {0, -1, 0, -8}, {dReal(0.6), dReal(0.48), dReal(0.64), -12}};
  for (const SpaceKind& kind : space_kinds()) {
    CAPTURE(kind.name);
    const dSpaceID space = kind.create();
    Random random(4);
    for (int i = 0; i < 100; ++i)
      place(random_body(random, space), {random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)});
    for (const auto& p : planes) {
      const dGeomID plane = dCreatePlane(space, p[0], p[1], p[2], p[3]);
      Found found;
      dSpaceCollide(space, &found, find_pair);
      const auto calls = std::count_if(found.near_pairs.begin(), found.near_pairs.end(),
                                       [&](const auto& pair) { return pair.first == plane || pair.second == plane; });
      CHECK(calls == 0);
      dGeomDestroy(plane);
    }
    dSpaceDestroy(space);
  }
}

TEST_CASE_FIXTURE(OdeSession,
                  "a box whose corner is in a body's bounding box but not near the body is culled, and a near one is not") {
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  snCreateEllipsoid(space, 1, 1, 1);
  const dGeomID box = dCreateBox(space, 1, 1, 1);
  const auto calls = [&] {
    int count = 0;
    dSpaceCollide(space, &count, [](void* n, dGeomID, dGeomID) { ++*static_cast<int*>(n); });
    return count;
  };
  const double touching = 0.5 + 1 / std::sqrt(3.0);  // the corner is on the unit sphere
  const double aside = within_rounding(1e-9, 4);
  place(box, {touching - aside, touching - aside, touching - aside});
  CHECK(calls() == 1);
  place(box, {touching + aside, touching + aside, touching + aside});
  CHECK(calls() == 0);
  dSpaceDestroy(space);
}

TEST_CASE_FIXTURE(OdeSession,
                  "a body of ours or a collider inside a dGeomTransform has the contacts and the box of the geom itself") {
  snSetDefaultSolver(SN_SOLVER_HYBRID, dReal(1e-13), 1000);  // the normal is accurate to the root of the tolerance
  Random random(8);
  const Geom transform(dCreateGeomTransform(nullptr)), plane(dCreatePlane(nullptr, 0, 0, 1, dReal(0.5)));
  for (const ColliderKind kind : kSolidKinds) {
    CAPTURE(name_of(kind));
    int touching = 0;
    for (int i = 0; i < 50; ++i) {
      Random one = random;
      Random same = random;
      const ColliderGeom inner(kind, one);
      const ColliderGeom direct(kind, same);
      const Geom body(random_body(random));
      wrap(transform, inner, direct, random);
      touching += check_same_contacts(transform, direct, body);
      if (kind != ColliderKind::Body) continue;
      check_same_contacts(transform, direct, plane);
      const Box box(transform), expected(direct);
      for (std::size_t k = 0; k < 6; ++k) CHECK(box.side[k] == relative(expected.side[k]).epsilon(1e-13));
    }
    CHECK(touching > 10);
  }
}

TEST_CASE_FIXTURE(OdeSession, "a geom offset moves the geom, not the body") {
  const World world;
  snSetDefaultSolver(SN_SOLVER_HYBRID, dReal(1e-13), 1000);  // the normal is accurate to the root of the tolerance
  Random random(6);
  int touching = 0;
  {
    std::vector<ColliderGeom> colliders;
    for (const ColliderKind kind : kColliderKinds) {
      colliders.emplace_back(kind, random);
      if (kind != ColliderKind::Plane) place(colliders.back(), {1, 2, -0.3});
    }
    for (int i = 0; i < 50; ++i) {
      const dBodyID body = dBodyCreate(world.id());
      dBodySetPosition(body, 1, 2, dReal(random.uniform(-0.5, 1)));
      dQuaternion q = {dReal(random.uniform(-1, 1)), dReal(random.uniform(-1, 1)), dReal(random.uniform(-1, 1)), 1};
      dNormalize4(q);
      dBodySetQuaternion(body, q);
      const Geom with_offset(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 4));
      dGeomSetBody(with_offset, body);
      dGeomSetOffsetPosition(with_offset, dReal(0.3), dReal(-0.2), dReal(0.5));
      dMatrix3 turned;
      dRFromAxisAndAngle(turned, 1, 2, 3, dReal(0.8));
      dGeomSetOffsetRotation(with_offset, turned);

      const Geom direct(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 4));
      dVector3 p;
      dBodyGetRelPointPos(body, dReal(0.3), dReal(-0.2), dReal(0.5), p);
      dMatrix3 R;
      dMultiply0(R, dBodyGetRotation(body), turned, 3, 3, 3);
      dGeomSetPosition(direct, p[0], p[1], p[2]);
      dGeomSetRotation(direct, R);

      for (const ColliderGeom& collider : colliders) touching += check_same_contacts(with_offset, direct, collider);
    }
    CHECK(touching > 100);
  }
}

TEST_CASE_FIXTURE(OdeSession, "the bounding box contains the support points, also far from the origin") {
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const Geom geom(random_body(random));
    const double scale = std::pow(10.0, random.uniform(0, 6));
    place(geom, scale * random.direction());
    const Box box(geom);
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int sign : {-1, 1}) {
        dVector3 direction = {0, 0, 0, 0};
        direction[k] = dReal(sign);
        dVector3 point;
        REQUIRE(snGeomSupport(geom, direction, point) == 1);
        const std::size_t side = 2 * k + (sign > 0 ? 1 : 0);
        CHECK(dReal(sign) * box.side[side] >= dReal(sign) * point[k]);
        CHECK(std::abs(box.side[side] - point[k]) < within_rounding(1e-13) * (1 + scale));
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "the bounding box follows the parameters, the rounding and the pose") {
  const Geom geom(snCreateEllipsoid(nullptr, 1, 2, 3));
  const auto check_half = [&](double x, double y, double z) {
    const Box box(geom);
    CHECK(box.side[1] == relative(x).epsilon(within_rounding(1e-14)));
    CHECK(box.side[3] == relative(y).epsilon(within_rounding(1e-14)));
    CHECK(box.side[5] == relative(z).epsilon(within_rounding(1e-14)));
  };
  check_half(1, 2, 3);
  REQUIRE(snGeomSuperellipsoidSetParams(geom, 4, 5, 6, 8, 8) == 1);
  check_half(4, 5, 6);
  REQUIRE(snGeomSetRounding(geom, dReal(0.5)) == 1);
  check_half(4.5, 5.5, 6.5);
  REQUIRE(snGeomSuperellipsoidSetParams(geom, 1, 1, 1, 2, 2) == 1);
  check_half(1.5, 1.5, 1.5);  // the rounding stays
  REQUIRE(snGeomSetRounding(geom, 0) == 1);
  check_half(1, 1, 1);
  dGeomSetPosition(geom, 10, 0, 0);
  check_half(11, 1, 1);
}
