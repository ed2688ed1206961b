// Tests of snCreateConvex: a body that the program defines.
#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "ode/terrain.hpp"

using namespace supernormal::test;

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

}  // namespace

TEST_CASE("user shape: the contacts are those of the built-in body of the same form") {
  OdeSession session;
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

TEST_CASE("user shape: release is called once, when the geom is destroyed, and never after a refusal") {
  OdeSession session;
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

TEST_CASE("user shape: the parameters of a superellipsoid are refused") {
  OdeSession session;
  Egg egg;
  const snShape shape = describe(egg, false);
  const Geom geom(snCreateConvex(nullptr, &shape));
  dReal a = 7;
  CHECK(snGeomSuperellipsoidGetParams(geom, &a, &a, &a, &a, &a) == 0);
  CHECK(refused(snGeomSuperellipsoidSetParams(geom, 1, 1, 1, 2, 2), "user-defined body"));
  CHECK(a == 7);
}

TEST_CASE("user shape: an exception in a callback becomes the error of the call and does not reach ODE") {
  OdeSession session;
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

TEST_CASE("user shape: callbacks that later return no number, no width or a reversed body are refused, and nothing hangs") {
  OdeSession session;
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

TEST_CASE("user shape: an exception in release becomes the last error and does not end the program") {
  OdeSession session;
  Egg egg;
  snShape shape = describe(egg, false);
  shape.release = [](void*) { throw std::runtime_error("the egg sticks"); };
  dGeomDestroy(snCreateConvex(nullptr, &shape));
  CHECK(std::string(snLastError()) == "release: the egg sticks");
}
