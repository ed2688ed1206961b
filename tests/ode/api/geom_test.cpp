// What a geom says of itself: mass, support, mesh; in ODE's conventions.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/ode_fixture.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

// A ball of radius 1 with its centre off the origin: h(n) = 1 + offset.n.
constexpr Vec kOffset = {0.2, -0.1, 0.3};
dReal ball_support(const void* /*user*/, const dReal n[3]) { return dReal(1 + dot(kOffset, to_vec(n))); }
void ball_point(const void* /*user*/, const dReal n[3], dReal point[3]) {
  for (std::size_t i = 0; i < 3; ++i) point[i] = dReal(n[i] + kOffset[i]);
}

// An ellipsoid with half-axes of some 10 km in a general orientation: h(n) = |A n|.
Vec oblique(const Vec& n) { return {9000 * n[0] + 4000 * n[1], 11000 * n[1] + 3000 * n[2], 7000 * n[2] + 2000 * n[0]}; }
dReal oblique_support(const void* /*user*/, const dReal n[3]) { return dReal(norm(oblique(to_vec(n)))); }
void oblique_point(const void* /*user*/, const dReal n[3], dReal point[3]) {
  const Vec v = oblique(to_vec(n));
  const double h = norm(v);
  const Vec r = {9000 * v[0] + 2000 * v[2], 4000 * v[0] + 11000 * v[1], 3000 * v[1] + 7000 * v[2]};
  for (std::size_t i = 0; i < 3; ++i) point[i] = dReal(r[i] / h);
}

/// The boundary point with this normal.
Vec support(dGeomID geom, const Vec& normal) {
  const dVector3 n = {dReal(normal[0]), dReal(normal[1]), dReal(normal[2]), 0};
  dVector3 point;
  REQUIRE(snGeomSupport(geom, n, point) == 1);
  return to_vec(point);
}

double volume(const snMesh& mesh) {
  double sum = 0;
  for (int k = 0; k < mesh.triangles; ++k) {
    const auto corner = [&](int i) { return to_vec(mesh.position + 3 * mesh.index[3 * k + i]); };
    const Vec a = corner(0), b = corner(1), c = corner(2);
    sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "mass: a total mass scales the inertia") {
  const Geom geom(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 5));
  dMass by_density, by_total;
  REQUIRE(snMassSet(&by_density, 1, geom) == 1);
  REQUIRE(snMassSetTotal(&by_total, 42, geom) == 1);
  CHECK(by_total.mass == relative(42).epsilon(1e-14));
  for (const int i : {0, 5, 10})
    CHECK(by_total.I[i] / by_total.mass == relative(by_density.I[i] / by_density.mass).epsilon(within_rounding(1e-14)));
}

TEST_CASE_FIXTURE(OdeSession, "mass: a sphere off the origin has the inertia of dMassTranslate") {
  const snShape shape = {ball_support, ball_point, nullptr, nullptr, nullptr};
  const Geom geom(snCreateConvex(nullptr, &shape));
  REQUIRE(dGeomID(geom) != nullptr);
  dMass mass, reference;
  dMassSetSphere(&reference, 5, 1);
  dMassTranslate(&reference, dReal(kOffset[0]), dReal(kOffset[1]), dReal(kOffset[2]));
  REQUIRE(snMassSet(&mass, 5, geom) == 1);
  CHECK(mass.mass == relative(reference.mass).epsilon(within_rounding(1e-9)));
  for (std::size_t i = 0; i < 3; ++i) CHECK(mass.c[i] == relative(kOffset[i]).epsilon(within_rounding(1e-9)));
  for (int i = 0; i < 12; ++i) {
    if (i % 4 == 3) continue;  // padding
    CHECK(mass.I[i] == relative(reference.I[i]).epsilon(within_rounding(1e-8)));
  }
  CHECK(dMassCheck(&mass) == 1);
}

TEST_CASE_FIXTURE(OdeSession, "mass: a centre of mass within rounding of the origin is at the origin, at any size") {
  const World world;
  const snShape shape = {oblique_support, oblique_point, nullptr, nullptr, nullptr};
  const Geom geom(snCreateConvex(nullptr, &shape));
  REQUIRE(dGeomID(geom) != nullptr);
  dMass mass;
  REQUIRE(snMassSet(&mass, 1000, geom) == 1);
  for (const int i : {0, 1, 2}) CHECK(mass.c[i] == 0);
  dBodySetMass(dBodyCreate(world.id()), &mass);  // ODE asserts it
}

TEST_CASE_FIXTURE(OdeSession, "mass: ODE accepts the mass of every body in its range") {
  const World world;
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    const double scale = std::pow(10.0, random.uniform(-4, 4));
    const auto axis = [&] { return dReal(scale * std::pow(10.0, random.uniform(-1, 1))); };
    const auto exponent = [&] { return dReal(std::pow(10.0, random.uniform(0.01, 2.5))); };
    const Geom geom(snCreateSuperellipsoid(nullptr, axis(), axis(), axis(), exponent(), exponent()));
    REQUIRE(dGeomID(geom) != nullptr);
    dMass mass;
    REQUIRE(snMassSet(&mass, 1000, geom) == 1);
    CHECK(dMassCheck(&mass) == 1);
    dBodySetMass(dBodyCreate(world.id()), &mass);  // ODE asserts it
  }
}

TEST_CASE_FIXTURE(OdeSession, "support: the farthest boundary point is returned for a direction of any length") {
  Random random(16);
  for (int i = 0; i < 100; ++i) {
    const Geom geom(random_body(random));
    place(geom, {4, 5, 6});
    const Vec n = random.direction();
    const Vec farthest = support(geom, n);
    for (int k = 0; k < 50; ++k) CHECK(dot(n, support(geom, random.direction())) <= dot(n, farthest) + 1e-13);
    for (const double length : {1e-200, 0.1, 7.0, 1e200}) {
      if (length < double{std::numeric_limits<dReal>::min()} || length > double{std::numeric_limits<dReal>::max()}) continue;
      CHECK(norm(support(geom, length * n) - farthest) < within_rounding(1e-13));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "a mesh has the volume of its geom, and its vertices have the geom's normals") {
  const Geom geom(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 3));
  REQUIRE(snGeomSetRounding(geom, dReal(0.05)) == 1);
  dMass mass;
  REQUIRE(snMassSet(&mass, 1, geom) == 1);
  snMesh mesh;
  REQUIRE(snGeomTessellate(geom, dReal(2e-4), &mesh) == 1);
  CHECK(volume(mesh) == relative(mass.mass).epsilon(1e-3));
  CHECK(volume(mesh) < mass.mass);  // its vertices are on the boundary of a convex body
  for (int k = 0; k < mesh.points; ++k) {
    const Vec apart = support(geom, to_vec(mesh.normal + 3 * k)) - to_vec(mesh.position + 3 * k);
    for (const double along : apart) CHECK(std::abs(along) < within_rounding(1e-12));
  }
  snMeshRelease(&mesh);
  CHECK(mesh.position == nullptr);
  snMeshRelease(&mesh);
  snMeshRelease(nullptr);
}

TEST_CASE_FIXTURE(OdeSession, "a mesh with invalid arguments is refused and empty") {
  const Geom geom(snCreateEllipsoid(nullptr, 3, 2, 1));
  snMesh mesh;
  for (const dReal wrong : {dReal(0), dReal(-1), std::numeric_limits<dReal>::quiet_NaN(), std::numeric_limits<dReal>::infinity()}) {
    CHECK(refused(snGeomTessellate(geom, wrong, &mesh), "chord_error ="));
    CHECK(mesh.triangles == 0);
    CHECK(mesh.position == nullptr);
  }
  CHECK(snGeomTessellate(geom, dReal(0.1), nullptr) == 0);
  CHECK(snGeomTessellate(nullptr, dReal(0.1), &mesh) == 0);
  dGeomID sphere = dCreateSphere(nullptr, 1);
  CHECK(snGeomTessellate(sphere, dReal(0.1), &mesh) == 0);
  dGeomDestroy(sphere);
}
