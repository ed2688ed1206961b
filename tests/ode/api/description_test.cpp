// Tests of snGeomDescribe, snCreateFromDescription and snGeomCopy.
#include "supernormal/shapes/description.hpp"

#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ode/collider_fixture.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/ode_world.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

std::string text_of(dGeomID geom) {
  std::string text(static_cast<std::size_t>(snGeomDescribe(geom, nullptr, 0)) + 1, '?');
  CHECK(snGeomDescribe(geom, text.data(), static_cast<int>(text.size())) == static_cast<int>(text.size()) - 1);
  CHECK(text.back() == '\0');
  text.pop_back();
  return text;
}

/// A shape of every kind of the core, about 1 m large.
const std::array kTexts = {
    "Sphere(radius=0.5)",
    "Ellipsoid(half_axes=(0.5, 0.4, 0.3))",
    "Superellipsoid(half_axes=(0.5, 0.4, 0.3), delta=4, epsilon=1.5)",
    "Superovoid(half_axes=(0.5, 0.4, 0.3), delta=2.5, epsilon=2, taper_x=0.3, taper_y=0.2)",
    "Box(half_lengths=(0.5, 0.4, 0.3))",
    "Capsule(radius=0.2, half_length=0.3)",
    "Cylinder(radius=0.3, half_length=0.4)",
    "Polytope(points=[(0.5, 0, -0.2), (-0.4, 0.3, -0.2), (-0.4, -0.3, -0.2), (0, 0, 0.5)])",
    "Rounded(core=Box(half_lengths=(0.3, 0.2, 0.1)), radius=0.1)",
    "Rounded(core=Rounded(core=Ellipsoid(half_axes=(0.3, 0.2, 0.1)), radius=0.1), radius=0.2)",
    "MinkowskiSum(first=Cylinder(radius=0.2, half_length=0.3), second=Ellipsoid(half_axes=(0.3, 0.1, 0.2)))",
    "LinearImage(shape=Cylinder(radius=0.3, half_length=0.4), matrix=((1, 0.2, 0), (0, 1, 0.3), (0, 0, 1)))"};

dReal balloon_support(const void* /*user*/, const dReal* /*n*/) { return dReal(0.5); }
void balloon_point(const void* /*user*/, const dReal* n, dReal* point) {
  for (int k = 0; k < 3; ++k) point[k] = dReal(0.5) * n[k];
}
void count_release(void* user) { ++*static_cast<int*>(user); }

}  // namespace

TEST_CASE_FIXTURE(OdeSession,
                  "description: every body of the C interface has a text, and a body of this text makes the same contacts") {
  snSetWarmStart(0);
  std::vector<dGeomID> originals;
  for (const dReal rounding : {dReal(0), dReal(0.1)}) {
    for (const dGeomID geom :
         {snCreateEllipsoid(nullptr, 1, dReal(0.7), dReal(0.4)), snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.4), 8, 3),
          snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.4), 2, 2), snCreateCapsule(nullptr, dReal(0.3), dReal(0.9)),
          snCreateSuperovoid(nullptr, 1, dReal(0.7), dReal(0.4), 2, 2, dReal(0.3), dReal(0.1))}) {
      CHECK(snGeomSetRounding(geom, rounding) == 1);
      originals.push_back(geom);
    }
  }
  Random random(3);
  for (const dGeomID original : originals) {
    const Geom geom(original), made(snCreateFromDescription(nullptr, text_of(geom).c_str()));
    REQUIRE(made != nullptr);
    CHECK(text_of(made) == text_of(geom));
    for (const ColliderKind kind : kColliderKinds) {
      const ColliderGeom other(kind, random);
      random.turn(geom);
      place(geom, 0.5 * random.direction());
      dGeomSetRotation(made, dGeomGetRotation(geom));
      place(made, to_vec(dGeomGetPosition(geom)));
      CHECK(same_bits(collide(geom, other), collide(made, other)));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "description: parameters and rounding of a body that was read can be read and set") {
  const Geom egg(snCreateFromDescription(
      nullptr, "Rounded(core=Superovoid(half_axes=(1, 2, 3), delta=2.5, epsilon=2, taper_x=0.25, taper_y=0.125), radius=0.5)"));
  std::array<dReal, 7> p{};
  CHECK(snGeomSuperovoidGetParams(egg, &p[0], &p[1], &p[2], &p[3], &p[4], &p[5], &p[6]) == 1);
  CHECK(p == std::array<dReal, 7>{1, 2, 3, 2.5, 2, 0.25, 0.125});
  CHECK(snGeomSuperovoidSetParams(egg, 3, 2, 1, 4, 2, dReal(-0.25), dReal(0.25)) == 1);
  CHECK(text_of(egg) ==
        "Rounded(core=Superovoid(half_axes=(3, 2, 1), delta=4, epsilon=2, taper_x=-0.25, taper_y=0.25), radius=0.5)");
  CHECK(snGeomSuperovoidSetParams(egg, 1, 2, 3, 2.5, 2, 0.25, 0.125) == 1);
  CHECK(snGeomSetRounding(egg, 0) == 1);
  CHECK(text_of(egg) == "Superovoid(half_axes=(1, 2, 3), delta=2.5, epsilon=2, taper_x=0.25, taper_y=0.125)");
  const Geom grain(snCreateFromDescription(nullptr, "Superellipsoid(half_axes=(1, 2, 3), delta=4, epsilon=5)"));
  CHECK(snGeomSuperellipsoidGetParams(grain, &p[0], &p[1], &p[2], &p[3], &p[4]) == 1);
  CHECK(std::array<dReal, 5>{p[0], p[1], p[2], p[3], p[4]} == std::array<dReal, 5>{1, 2, 3, 4, 5});
}

TEST_CASE_FIXTURE(OdeSession, "description: lengths and exponents are the ones that a body is created with") {
  const std::pair<dGeomID, const char*> bodies[] = {
      {snCreateEllipsoid(nullptr, 3, 2, 1), "Ellipsoid(half_axes=(3, 2, 1))"},
      {snCreateSuperellipsoid(nullptr, 3, 2, 1, 4, 5), "Superellipsoid(half_axes=(3, 2, 1), delta=4, epsilon=5)"},
      {snCreateCapsule(nullptr, 2, 5), "Capsule(radius=2, half_length=2.5)"},
      {snCreateCapsule(nullptr, 1, 0), "Capsule(radius=1, half_length=0)"},
      {snCreateSuperovoid(nullptr, 3, 2, 1, 2.5, 4, 0.5, 0.5),
       "Superovoid(half_axes=(3, 2, 1), delta=2.5, epsilon=4, taper_x=0.5, taper_y=0.5)"}};
  for (const auto& [id, text] : bodies) {
    const Geom geom(id);
    REQUIRE(id != nullptr);
    CHECK(text_of(geom) == text);
  }
}

TEST_CASE_FIXTURE(OdeSession, "description: a short array gets the beginning of the text, and the length of the whole") {
  const Geom ball(snCreateEllipsoid(nullptr, 1, 1, 1));
  char text[10] = "*********";
  CHECK(snGeomDescribe(ball, text, 5) == 30);
  CHECK(std::string(text, 9) == std::string("Elli\0****", 9));
  CHECK(snGeomDescribe(ball, text, 1) == 30);
  CHECK(std::string(text).empty());
  CHECK(snGeomDescribe(ball, nullptr, 0) == 30);
}

TEST_CASE_FIXTURE(OdeSession,
                  "description: a geom of every shape of the core has the core's answers beside every convex class of ODE") {
  Random random(8);
  int overlaps = 0;
  const std::string earlier = snLastError();  // of another test
  for (const char* text : kTexts) {
    CAPTURE(text);
    const auto shape = read_shape(text);
    const Geom geom(snCreateFromDescription(nullptr, text));
    REQUIRE(geom != nullptr);
    CHECK(text_of(geom) == text);
    for (int round = 0; round < 20; ++round) {
      for (const ColliderKind kind : kColliderKinds) {
        const ColliderGeom other(kind, random);
        random.turn(geom);
        place(geom, random.uniform(0, 1.5) * random.direction());
        const snProximity found = proximity_of(geom, other);
        CHECK(found.converged == 1);
        CHECK(norm(to_vec(found.normal)) == doctest::Approx(1).epsilon(within_rounding(1e-12)));
        if (kind == ColliderKind::Body) {
          const auto other_shape = read_shape(text_of(other));
          const Proximity expected = find_proximity(*shape, pose_of(geom), *other_shape, pose_of(other));
          // Of several local maxima of a deep overlap, both may find another.
          if (expected.gap > -0.05) CHECK(found.gap == doctest::Approx(expected.gap).epsilon(within_rounding(1e-7, 10)));
        }
        const std::vector<dContactGeom> contacts = collide(geom, other);
        CHECK(contacts.empty() == (found.gap >= 0));
        if (contacts.empty()) continue;
        ++overlaps;
        CHECK(contacts[0].depth == doctest::Approx(-found.gap).epsilon(within_rounding(1e-6, 10)));
      }
    }
    CHECK(snLastError() == earlier);
  }
  CHECK(overlaps > 300);
}

TEST_CASE_FIXTURE(OdeSession, "description: a Box of ours lies on a plane and on a dBox as a dBox does") {
  const Geom ours(snCreateFromDescription(nullptr, "Box(half_lengths=(0.5, 0.4, 0.3))")),
      odes(dCreateBox(nullptr, 1, dReal(0.8), dReal(0.6)));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0)), table(dCreateBox(nullptr, 4, 4, 1));
  place(table, {0, 0, -0.5});
  for (const dGeomID geom : {dGeomID(ours), dGeomID(odes)}) place(geom, {0, 0, 0.29});
  for (const dGeomID floor : {dGeomID(plane), dGeomID(table)}) {
    const auto contacts = collide(ours, floor), expected = collide(odes, floor);
    CHECK(contacts.size() == 4);
    CHECK(expected.size() >= 4);
    for (const dContactGeom& contact : contacts) {
      CHECK(contact.depth == doctest::Approx(0.01).epsilon(within_rounding(1e-9, 100)));
      CHECK(std::abs(contact.pos[0]) == doctest::Approx(0.5));
      CHECK(std::abs(contact.pos[1]) == doctest::Approx(0.4));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "copy: a geom's copy has its shape, its bits and its place, and lives on") {
  const World world;
  dBodyID body = dBodyCreate(world.id());
  dSpaceID space = dHashSpaceCreate(nullptr);
  auto geom = std::make_unique<Geom>(snCreateSuperellipsoid(nullptr, 1, 2, 3, 4, 5));
  snGeomSetRounding(*geom, dReal(0.25));
  dGeomSetBody(*geom, body);
  dGeomSetOffsetPosition(*geom, 1, 0, 0);
  dBodySetPosition(body, 5, 6, 7);
  dGeomSetCategoryBits(*geom, 6);
  dGeomSetCollideBits(*geom, 12);
  dGeomDisable(*geom);
  const std::string text = text_of(*geom);
  const Vec there = to_vec(dGeomGetPosition(*geom));
  auto copied = std::make_unique<Geom>(snGeomCopy(space, *geom));
  const dGeomID copy = *copied;
  geom.reset();
  CHECK(text_of(copy) == text);
  CHECK(to_vec(dGeomGetPosition(copy)) == there);
  CHECK(there == Vec{6, 6, 7});
  CHECK(dGeomGetBody(copy) == nullptr);
  CHECK(dGeomGetSpace(copy) == space);
  CHECK(dGeomGetCategoryBits(copy) == 6);
  CHECK(dGeomGetCollideBits(copy) == 12);
  CHECK(dGeomIsEnabled(copy) == 0);
  CHECK(snGeomSuperellipsoidSetParams(copy, 1, 1, 1, 2, 2) == 1);
  CHECK(text_of(copy) == "Rounded(core=Ellipsoid(half_axes=(1, 1, 1)), radius=0.25)");
  copied.reset();
  dSpaceDestroy(space);
  dBodyDestroy(body);
}

TEST_CASE_FIXTURE(OdeSession, "copy: solver settings and look-ahead time are copied") {
  snSetWarmStart(0);
  const Geom geom(snCreateSuperellipsoid(nullptr, 1, 2, 3, 4, 5)), other(snCreateEllipsoid(nullptr, 1, 2, 3));
  place(other, {4, 3, 5});
  snProximity exact, rough, copied;
  CHECK(snGeomProximity(geom, other, &exact) == 1);
  snGeomSetSolver(geom, SN_SOLVER_HYBRID, dReal(1e-9), 1);
  snGeomSetSolver(other, SN_SOLVER_HYBRID, dReal(1e-9), 1);
  CHECK(snGeomProximity(geom, other, &rough) == 1);
  REQUIRE(rough.evaluations < exact.evaluations);
  const Geom copy(snGeomCopy(nullptr, geom));
  CHECK(snGeomProximity(copy, other, &copied) == 1);
  CHECK(copied.evaluations == rough.evaluations);
  // The order of the two bodies follows their serial numbers, so the sums are rounded otherwise.
  CHECK(copied.gap == doctest::Approx(rough.gap).epsilon(within_rounding(1e-12)));

  dReal before[6], after[6], of_copy[6];
  const World world;
  dBodyID body = dBodyCreate(world.id()), body_of_copy = dBodyCreate(world.id());
  for (const dBodyID moving : {body, body_of_copy}) dBodySetLinearVel(moving, 8, 0, 0);
  dGeomSetBody(geom, body);
  dGeomGetAABB(geom, before);
  snGeomSetLookAhead(geom, dReal(0.5));
  dGeomGetAABB(geom, after);
  REQUIRE(after[1] > before[1] + 3);
  const Geom ahead(snGeomCopy(nullptr, geom));
  dGeomSetBody(ahead, body_of_copy);
  dGeomGetAABB(ahead, of_copy);
  for (int k = 0; k < 6; ++k) CHECK(of_copy[k] == after[k]);
  dGeomSetBody(geom, nullptr);
  dGeomSetBody(ahead, nullptr);
}

TEST_CASE_FIXTURE(OdeSession, "copy: copies of a user-defined body share its callbacks, which are released once, after the last") {
  int released = 0;
  const snShape shape = {balloon_support, balloon_point, nullptr, &released, count_release};
  {
    auto geom = std::make_unique<Geom>(snCreateConvex(nullptr, &shape));
    REQUIRE(*geom != nullptr);
    snGeomSetRounding(*geom, dReal(0.25));
    auto copy = std::make_unique<Geom>(snGeomCopy(nullptr, *geom));
    const Geom last(snGeomCopy(nullptr, *copy));
    geom.reset();
    copy.reset();
    CHECK(released == 0);
    CHECK(snGeomPointDepth(last, 0, 0, 0) == doctest::Approx(0.75));
  }
  CHECK(released == 1);
}

TEST_CASE_FIXTURE(OdeSession, "description and copy: what cannot be is refused") {
  const snShape shape = {balloon_support, balloon_point, nullptr, nullptr, nullptr};
  const Geom user(snCreateConvex(nullptr, &shape)), sphere(dCreateSphere(nullptr, 1)),
      ellipsoid(snCreateEllipsoid(nullptr, 1, 1, 1));
  char text[100];
  CHECK(snGeomDescribe(user, text, 100) == -1);
  CHECK(refused_with("snGeomDescribe: shape is a supernormal::CallbackShape, which has no description"));
  CHECK(snGeomDescribe(sphere, text, 100) == -1);
  CHECK(refused_with("geom is a dSphere, but must be a body made by snCreate"));
  CHECK(snGeomDescribe(ellipsoid, nullptr, 100) == -1);
  CHECK(refused_with("text = NULL"));
  CHECK(snGeomDescribe(ellipsoid, text, -1) == -1);
  CHECK(refused_with("capacity = -1, but must be at least 0"));
  CHECK(refused(snGeomCopy(nullptr, sphere), "snGeomCopy: geom is a dSphere"));
  CHECK(snGeomCopy(nullptr, nullptr) == nullptr);
  CHECK(refused(snCreateFromDescription(nullptr, nullptr), "text = NULL"));
  CHECK(refused(snCreateFromDescription(nullptr, "Ellipsoid(half_axes=(1, 2))"),
                "snCreateFromDescription: text at character 26 is \"))\", but must be \",\""));
  CHECK(refused(snCreateFromDescription(nullptr, "Polytope(points=[(0, 0, 0), (1, 0, 0), (0, 1, 0)])"),
                "the half-width of the shape along z = 0 m is outside [1e-30, 1e+30] m"));
  CHECK(snCreateFromDescription(nullptr, "Sphere(radius=0)") == nullptr);
}
