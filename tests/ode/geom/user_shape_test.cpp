// Bodies of a program's own shapes, by callbacks and by C++ classes.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "ode/terrain.hpp"
#include "supernormal/geom.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/supernormal.h"
#include "support/ode_fixture.hpp"

using namespace supernormal::test;
using namespace supernormal;

namespace {

// An ellipsoid defined by the program, which counts the calls.
struct Egg {
  double a = 1, b = 0.8, c = 0.6;
  int released = 0;
  bool broken = false;
  double factor = 1;  // of all that the callbacks return
};

dReal egg_support(const void* user, const dReal n[3]) {
  const Egg& egg = *static_cast<const Egg*>(user);
  if (egg.broken) throw std::runtime_error("the egg broke");
  return dReal(egg.factor * norm({egg.a * n[0], egg.b * n[1], egg.c * n[2]}));
}

void egg_point(const void* user, const dReal n[3], dReal point[3]) {
  const Egg& egg = *static_cast<const Egg*>(user);
  if (egg.broken) throw std::runtime_error("the egg broke");
  const double h = norm({egg.a * n[0], egg.b * n[1], egg.c * n[2]});
  point[0] = dReal(egg.factor * (egg.a * egg.a * n[0] / h));
  point[1] = dReal(egg.factor * (egg.b * egg.b * n[1] / h));
  point[2] = dReal(egg.factor * (egg.c * egg.c * n[2] / h));
}

void egg_hessian(const void* user, const dReal n[3], dReal H[9]) {
  const Egg& egg = *static_cast<const Egg*>(user);
  const double h = egg_support(user, n);
  const Vec squares = {egg.a * egg.a, egg.b * egg.b, egg.c * egg.c};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      H[3 * i + j] = dReal((i == j ? squares[i] / h : 0) - squares[i] * n[i] * squares[j] * n[j] / (h * h * h));
    }
  }
}

void release_egg(void* user) { ++static_cast<Egg*>(user)->released; }

snShape describe(Egg& egg, bool with_hessian) {
  return {egg_support, egg_point, with_hessian ? egg_hessian : nullptr, &egg, release_egg};
}

/// A class as a program writes it: an ellipsoid by its support function and boundary point, or what a mistake makes of it.
class OwnShape final : public Shape {
 public:
  explicit OwnShape(double factor_of_point = 1) : factor_of_point_(factor_of_point) {}
  void evaluate(const Vector3& n, Order /*order*/, Jet& jet) const override {
    jet.h = n.cwiseProduct(kHalfAxes).norm();
    jet.r = factor_of_point_ * n.cwiseProduct(kHalfAxes.cwiseAbs2()) / jet.h;
  }
  inline static const Vector3 kHalfAxes = {0.3, 0.2, 0.1};  // m

 private:
  double factor_of_point_;
};

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "user shape: the contacts are those of the built-in body of the same form") {
  // The functions of a user shape return dReals. In single precision the query converges only to this rounding.
  snSetDefaultSolver(SN_SOLVER_HYBRID, dReal(within_rounding(1e-9, 100)), 1000);
  Random random(12);
  Egg egg;
  for (const bool with_hessian : {true, false}) {
    CAPTURE(with_hessian);
    const snShape shape = describe(egg, with_hessian);
    const Geom user(snCreateConvex(nullptr, &shape));
    const Geom built_in(snCreateEllipsoid(nullptr, 1, dReal(0.8), dReal(0.6)));
    const Geom collider(snCreateSuperellipsoid(nullptr, 1, 1, 1, 3, 3));
    const Geom sphere(dCreateSphere(nullptr, 1));
    const Geom plane(dCreatePlane(nullptr, 0, 0, 1, dReal(-0.3)));
    for (int i = 0; i < 100; ++i) {
      random.turn(user);
      dGeomSetRotation(built_in, dGeomGetRotation(user));
      const Vec where = random.uniform(1.3, 2.2) * random.direction();
      place(user, where);
      place(built_in, where);
      for (const dGeomID other : {dGeomID(collider), dGeomID(sphere), dGeomID(plane)}) {
        const snProximity mine = proximity_of(user, other), reference = proximity_of(built_in, other);
        CHECK(mine.converged == 1);
        CHECK(std::abs(mine.gap - reference.gap) < within_rounding(3e-9, 100));
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "user shape: release is called once, when the geom is destroyed, and never after a refusal") {
  Egg egg;
  const snShape good = describe(egg, true);
  const dGeomID geom = snCreateConvex(nullptr, &good);
  REQUIRE(geom != nullptr);
  REQUIRE(snGeomSetRounding(geom, 1) == 1);
  REQUIRE(snGeomSetRounding(geom, 0) == 1);
  CHECK(egg.released == 0);
  dGeomDestroy(geom);
  CHECK(egg.released == 1);

  snShape bad = good;
  bad.support = [](const void*, const dReal*) { return dReal(-1); };
  CHECK(refused(snCreateConvex(nullptr, &bad), "snCreateConvex: "));
  bad = good;
  bad.point = nullptr;
  CHECK(snCreateConvex(nullptr, &bad) == nullptr);
  CHECK(std::string(snLastError()) == "snCreateConvex: shape->point = NULL, but a body needs its boundary point");
  CHECK(snCreateConvex(nullptr, nullptr) == nullptr);
  CHECK(egg.released == 1);
}

TEST_CASE_FIXTURE(OdeSession, "user shape: an exception in a callback becomes the error of the call and does not reach ODE") {
  Egg egg;
  const snShape shape = describe(egg, true);
  const dSpaceID space = dHashSpaceCreate(nullptr);
  const dGeomID geom = snCreateConvex(space, &shape);
  const dGeomID other = snCreateEllipsoid(space, 1, 1, 1);
  const dGeomID plane = dCreatePlane(space, 0, 0, 1, 0);
  egg.broken = true;
  CHECK(collide(geom, other).empty());
  CHECK(std::string(snLastError()) == "dCollide: the egg broke");
  CHECK(collide(plane, geom).empty());
  dGeomSetPosition(geom, 1, 1, 1);
  int pairs = 0;
  dSpaceCollide(space, &pairs, [](void* count, dGeomID, dGeomID) { ++*static_cast<int*>(count); });
  CHECK(pairs == 3);  // without a box ODE must assume the worst
  CHECK(std::isnan(snGeomPointDepth(geom, 0, 0, 0)));
  dMass mass;
  CHECK(snMassSet(&mass, 1, geom) == 0);
  egg.broken = false;
  CHECK(snMassSet(&mass, 1, geom) == 1);
  dSpaceDestroy(space);
  CHECK(egg.released == 1);
}

TEST_CASE_FIXTURE(OdeSession,
                  "user shape: callbacks that later return no number, no width or a reversed body are refused, and nothing hangs") {
  Egg egg;
  const snShape shape = describe(egg, false);
  const Geom geom(snCreateConvex(nullptr, &shape));
  const Geom ball(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Terrain terrain(Terrain::Layout{}, [](int i, int j) { return 0.1 * (i % 2) + 0.05 * (j % 3); });
  const Geom field(dCreateHeightfield(nullptr, terrain.data(), 0));
  const dVector3 up = {0, 0, 1, 0};
  for (const double factor : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.0, -1.0}) {
    CAPTURE(factor);
    egg.factor = factor;
    dGeomSetPosition(geom, 0, 0, 0);  // the box is new
    dReal aabb[6];
    dGeomGetAABB(geom, aabb);
    for (int axis = 0; axis < 3; ++axis) CHECK(aabb[2 * axis] <= aabb[2 * axis + 1]);
    snProximity answer;
    snImpact impact;
    CHECK(collide(geom, field).empty());
    CHECK(refused_with("dCollide: the numbers that describe"));
    CHECK(snGeomProximity(geom, field, &answer) == 0);
    CHECK(snGeomTimeOfImpact(geom, field, 1, &impact) == 0);
    if (std::isfinite(factor)) continue;
    dVector3 point = {7, 7, 7, 7};
    CHECK(refused(snGeomSupport(geom, up, point), "what a user-defined body returned, is not finite"));
    CHECK(point[0] == 7);
    snMesh mesh;
    CHECK(refused(snGeomTessellate(geom, dReal(0.01), &mesh), "snGeomTessellate: a boundary point of the shape is "));
    CHECK(mesh.points == 0);
    CHECK(snGeomProximity(geom, ball, &answer) == 0);
  }
}

TEST_CASE_FIXTURE(OdeSession, "user shape: an exception in release becomes the last error and does not end the program") {
  Egg egg;
  snShape shape = describe(egg, false);
  shape.release = [](void*) { throw std::runtime_error("the egg sticks"); };
  dGeomDestroy(snCreateConvex(nullptr, &shape));
  CHECK(std::string(snLastError()) == "release: the egg sticks");
}

TEST_CASE_FIXTURE(OdeSession, "a class of one's own collides in ODE as the ellipsoid that it is, and lives as long as its geom") {
  auto shape = std::make_shared<const OwnShape>();
  const std::weak_ptr<const OwnShape> alive = shape;
  {
    const Geom own(ode::create_geom(nullptr, shape));
    shape.reset();
    const Geom known(snCreateEllipsoid(nullptr, dReal(0.3), dReal(0.2), dReal(0.1)));
    const Geom floor(dCreatePlane(nullptr, 0, 0, 1, 0));
    const Geom box(dCreateBox(nullptr, 1, 1, dReal(0.1)));
    for (const dGeomID geom : {dGeomID(own), dGeomID(known)}) {
      dGeomSetPosition(geom, dReal(0.02), dReal(0.01), dReal(0.145));
      const dQuaternion turn = {dReal(0.9), dReal(0.1), dReal(0.3), dReal(0.3)};
      dGeomSetQuaternion(geom, turn);
    }
    for (const dGeomID other : {dGeomID(floor), dGeomID(box)}) {
      std::array<dContactGeom, 2> found{};
      REQUIRE(dCollide(own, other, 1, &found[0], sizeof(dContactGeom)) == 1);
      REQUIRE(dCollide(known, other, 1, &found[1], sizeof(dContactGeom)) == 1);
      CHECK(found[0].depth == doctest::Approx(found[1].depth).epsilon(sizeof(dReal) == 8 ? 1e-9 : 1e-4));
      for (int k = 0; k < 3; ++k) CHECK(std::abs(found[0].normal[k] - found[1].normal[k]) < (sizeof(dReal) == 8 ? 1e-7 : 1e-3));
    }
    CHECK_FALSE(alive.expired());
  }
  CHECK(alive.expired());
}

TEST_CASE_FIXTURE(OdeSession, "a geom of a known C++ shape is the geom that the C interface makes") {
  const Geom geom(ode::create_geom(
      nullptr, std::make_shared<const Rounded>(std::make_shared<const Superellipsoid>(Vector3(0.3, 0.2, 0.1), 4, 6), 0.05)));
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0;
  CHECK(snGeomSuperellipsoidGetParams(geom, &a, &b, &c, &delta, &epsilon) == 1);
  CHECK(std::array{a, b, c, delta, epsilon} == std::array{dReal(0.3), dReal(0.2), dReal(0.1), dReal(4), dReal(6)});
  std::array<char, 200> text{};
  CHECK(snGeomDescribe(geom, text.data(), static_cast<int>(text.size())) > 0);
  CHECK(std::string(text.data()).find("radius=0.05)") != std::string::npos);
}

TEST_CASE_FIXTURE(OdeSession, "mistakes in a C++ shape are refused with what is wrong") {
  const auto says = [](const std::shared_ptr<const Shape>& shape, const char* text) {
    CHECK_THROWS_WITH_AS(ode::create_geom(nullptr, shape), doctest::Contains(text), std::invalid_argument);
  };
  says(nullptr, "shape = NULL");
  says(std::make_shared<const OwnShape>(1.1), "differs from support");
  says(std::make_shared<const OwnShape>(std::numeric_limits<double>::quiet_NaN()), "is not finite");
}
