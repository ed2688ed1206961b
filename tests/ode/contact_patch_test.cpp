// Several contacts of one pair: how many, where, and that nothing jumps when their number changes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ode/ode_fixture.hpp"
#include "relative.hpp"

using namespace supernormal::test;

namespace {

using Contacts = std::vector<dContactGeom>;

/// What springs of unit stiffness at the contacts exert on the first body, over the deepest one's depth: per unit of overlap.
struct Wrench {
  Vec force{};
  Vec torque{};  // about the first body's centre, m

  Wrench(const Contacts& contacts, dGeomID first) {
    double deepest = 0;
    for (const dContactGeom& contact : contacts) {
      const Vec push = contact.depth * to_vec(contact.normal);
      const Vec arm = to_vec(contact.pos) - to_vec(dGeomGetPosition(first));
      force = force + push;
      torque = torque +
               Vec{arm[1] * push[2] - arm[2] * push[1], arm[2] * push[0] - arm[0] * push[2], arm[0] * push[1] - arm[1] * push[0]};
      deepest = std::max(deepest, double{contact.depth});
    }
    force = (1 / deepest) * force;
    torque = (1 / deepest) * torque;
  }
};

/// Tilts by `angle` about a horizontal axis and puts the body over the plane z = 0 or on top of `under` with the given depth.
void place(dGeomID body, dGeomID under, double angle, double direction, double depth) {
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, dReal(std::cos(direction)), dReal(std::sin(direction)), 0, dReal(angle));
  dGeomSetRotation(body, rotation);
  double height = 10;
  // Along z: exact for a plane, and after a few steps for the flat top of a body.
  for (int k = 0; k < 50; ++k) {
    dGeomSetPosition(body, 0, 0, dReal(height));
    snProximity proximity;
    REQUIRE(snGeomProximity(body, under, &proximity) == 1);
    const double excess = double{proximity.gap} + depth;
    if (std::abs(excess) <= 1e-9 * depth) return;
    height += excess / double{proximity.normal[2]};
  }
}

}  // namespace

TEST_CASE("there are never more contacts than there is room for, the deepest first") {
  const OdeSession session;
  const Geom floor(dCreatePlane(nullptr, 0, 0, 1, 0));
  const Geom brick(snCreateSuperellipsoid(nullptr, dReal(0.1), dReal(0.07), dReal(0.05), 20, 20));
  dGeomSetPosition(brick, 0, 0, dReal(0.0499));
  for (int room = 1; room <= 8; ++room) {
    const Contacts contacts = collide(brick, floor, room);
    REQUIRE(contacts.size() == static_cast<std::size_t>(std::min(room, 5)));
    CHECK(contacts[0].depth == relative(1e-4));
    for (std::size_t k = 1; k < contacts.size(); ++k) CHECK(contacts[k].depth == 0);
  }
}

TEST_CASE("swapped geoms have the same contacts, the normals turned") {
  const OdeSession session;
  snSetWarmStart(0);
  const Geom lower(snCreateSuperellipsoid(nullptr, dReal(0.1), dReal(0.07), dReal(0.05), 20, 12));
  const Geom upper(snCreateSuperellipsoid(nullptr, dReal(0.08), dReal(0.09), dReal(0.05), 9, 30));
  dGeomSetPosition(upper, dReal(0.03), dReal(0.02), dReal(0.0999));
  const Contacts contacts = collide(lower, upper);
  const Contacts swapped = collide(upper, lower);
  REQUIRE(contacts.size() == 5);
  REQUIRE(swapped.size() == 5);
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(norm(to_vec(contacts[k].pos) - to_vec(swapped[k].pos)) <= 1e-12);
    CHECK(norm(to_vec(contacts[k].normal) + to_vec(swapped[k].normal)) <= 1e-12);
    CHECK(contacts[k].g1 == lower.operator dGeomID());
    CHECK(swapped[k].g1 == upper.operator dGeomID());
  }
}

TEST_CASE("the wrench does not jump on the way from face to edge to corner") {
  const OdeSession session;
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  const Geom table(snCreateSuperellipsoid(nullptr, dReal(0.3), dReal(0.3), dReal(0.1), 6, 6));
  dGeomSetPosition(table, 0, 0, dReal(-0.1));
  constexpr double kLongest = 0.1;  // half-axis, m
  constexpr int kStepCount = 6000;
  constexpr double kTurn = 1.2 / kStepCount;  // rad
  for (const dGeomID under : {plane.operator dGeomID(), table.operator dGeomID()}) {
    for (const double exponent : {4.0, 8.0, 12.0}) {
      const Geom brick(
          snCreateSuperellipsoid(nullptr, dReal(kLongest), dReal(0.07), dReal(0.05), dReal(exponent), dReal(exponent)));
      // On a flat face the boundary point moves by the (exponent - 1)th root of the angle, and across the middle twice.
      const double most = 4 * kLongest * std::pow(kTurn * kLongest / 0.05, 1 / (exponent - 1));
      int changes = 0;
      std::size_t previous_count = 0;
      Vec previous_arm{};
      for (int step = 0; step <= kStepCount; ++step) {
        place(brick, under, kTurn * (step - 0.1 * kStepCount), 1.1, 2e-4);
        const Contacts contacts = collide(brick, under);
        REQUIRE(!contacts.empty());
        const Wrench wrench(contacts, brick);
        // However many there are, the force is that of the overlap.
        const Vec normal = to_vec(contacts[0].normal);
        REQUIRE(norm(wrench.force - normal) <= 1e-12);
        if (step > 0) {
          CAPTURE(exponent);
          CAPTURE(step);
          REQUIRE(norm(wrench.torque - previous_arm) <= most);
          changes += contacts.size() != previous_count ? 1 : 0;
        }
        previous_arm = wrench.torque;
        previous_count = contacts.size();
      }
      CAPTURE(exponent);
      if (exponent >= 8) CHECK(changes >= 2);
    }
  }
}
