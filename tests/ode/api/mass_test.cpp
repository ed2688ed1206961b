// Mass properties, in ODE's conventions.
#include <doctest/doctest.h>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

// Checks the principal moments for mass 1 against the second moments, and that all products of inertia are 0.
void check_inertia(const dMass& mass, const Vec& squares) {
  const double m = mass.mass;
  CHECK(mass.I[0] == relative(m * (squares[1] + squares[2])).epsilon(within_rounding(1e-12)));
  CHECK(mass.I[5] == relative(m * (squares[0] + squares[2])).epsilon(within_rounding(1e-12)));
  CHECK(mass.I[10] == relative(m * (squares[0] + squares[1])).epsilon(within_rounding(1e-12)));
  for (const int off_diagonal : {1, 2, 4, 6, 8, 9}) CHECK(std::abs(mass.I[off_diagonal]) < 1e-14 * m);
}

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

}  // namespace

TEST_CASE("mass: an ellipsoid has the textbook's values") {
  OdeSession session;
  const Geom geom(snCreateEllipsoid(nullptr, 3, 2, 1));
  dMass mass;
  REQUIRE(snMassSet(&mass, 1000, geom) == 1);
  CHECK(mass.mass == relative(1000 * 4.0 / 3 * std::acos(-1.0) * 6).epsilon(within_rounding(1e-14)));
  check_inertia(mass, {9.0 / 5, 4.0 / 5, 1.0 / 5});
  CHECK(dMassCheck(&mass) == 1);

  const Geom sphere(snCreateEllipsoid(nullptr, 2, 2, 2));
  dMass reference;
  dMassSetSphere(&reference, 7, 2);
  REQUIRE(snMassSet(&mass, 7, sphere) == 1);
  CHECK(mass.mass == relative(reference.mass).epsilon(within_rounding(1e-14)));
  for (const int i : {0, 5, 10}) CHECK(mass.I[i] == relative(reference.I[i]).epsilon(within_rounding(1e-14)));
}

TEST_CASE("mass: a total mass scales the inertia") {
  OdeSession session;
  const Geom geom(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 3, 5));
  dMass by_density, by_total;
  REQUIRE(snMassSet(&by_density, 1, geom) == 1);
  REQUIRE(snMassSetTotal(&by_total, 42, geom) == 1);
  CHECK(by_total.mass == relative(42).epsilon(1e-14));
  for (const int i : {0, 5, 10})
    CHECK(by_total.I[i] / by_total.mass == relative(by_density.I[i] / by_density.mass).epsilon(within_rounding(1e-14)));
}

TEST_CASE("mass: a sphere off the origin has the inertia of dMassTranslate") {
  OdeSession session;
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

TEST_CASE("mass: a centre of mass within rounding of the origin is at the origin, at any size") {
  OdeSession session;
  const World world;
  const snShape shape = {oblique_support, oblique_point, nullptr, nullptr, nullptr};
  const Geom geom(snCreateConvex(nullptr, &shape));
  REQUIRE(dGeomID(geom) != nullptr);
  dMass mass;
  REQUIRE(snMassSet(&mass, 1000, geom) == 1);
  for (const int i : {0, 1, 2}) CHECK(mass.c[i] == 0);
  dBodySetMass(dBodyCreate(world.id()), &mass);  // ODE asserts it
}

TEST_CASE("mass: ODE accepts the mass of every body in its range") {
  OdeSession session;
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
