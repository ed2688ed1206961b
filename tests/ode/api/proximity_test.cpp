// snGeomProximity, the solver settings and the statistics.
#include <doctest/doctest.h>

#include "support/ode_fixture.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

// Checks conditions that every answer must satisfy.
void check_consistent(const snProximity& p, double rounding) {
  CHECK(norm(to_vec(p.normal)) == relative(1).epsilon(within_rounding(1e-14)));
  const Vec d = to_vec(p.point2) - to_vec(p.point1);
  CHECK(std::abs(dot(d, to_vec(p.normal)) - p.gap) < within_rounding(rounding, 10));
  CHECK(p.error >= 0);
}

}  // namespace

TEST_CASE("certified: the depth is proved the minimum translation distance, and never larger than the depth of the plain query") {
  OdeSession session;
  Random random(61);
  int unproved = 0;
  for (int i = 0; i < 60; ++i) {
    const auto exponent = dReal(random.uniform(3, 30));
    const Geom body(snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.5), exponent, exponent));
    const Geom other(i % 2 == 0 ? dCreateBox(nullptr, 1, dReal(1.4), 2)
                                : snCreateSuperellipsoid(nullptr, dReal(0.6), dReal(0.8), 1, exponent, exponent));
    random.turn(body);
    random.turn(other);
    place(other, 0.6 * random.direction());
    const snProximity plain = proximity_of(body, other);
    snProximity certified;
    REQUIRE(snGeomProximityCertified(body, other, &certified) == 1);
    REQUIRE(certified.gap < 0);
    CHECK(certified.is_global == 1);
    CHECK(certified.gap >= plain.gap - plain.error - certified.error);
    check_consistent(certified, 1e-14);
    unproved += plain.is_global == 0 ? 1 : 0;
    snProximity swapped;
    REQUIRE(snGeomProximityCertified(other, body, &swapped) == 1);
    CHECK(swapped.gap == relative(certified.gap).epsilon(1e-8));
    move(other, (-certified.gap + 1e-6) * to_vec(certified.normal));
    CHECK(proximity_of(body, other).gap > 0);
  }
  CHECK(unproved > 30);
}

TEST_CASE("a pair uses the tighter tolerance and the larger limit, and a query that reaches the limit reports it") {
  OdeSession session;
  snSetWarmStart(0);
  const Geom g1(snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.4), 5, 3));
  const Geom g2(snCreateSuperellipsoid(nullptr, 1, dReal(0.6), dReal(0.5), 3, 5));
  place(g2, {1.5, 0.7, 0.6});
  Random random(21);
  random.turn(g1);
  random.turn(g2);
  const snProximity fine = proximity_of(g1, g2);
  REQUIRE(fine.converged == 1);
  REQUIRE(fine.evaluations > 2);

  snResetStatistics();
  REQUIRE(snGeomSetSolver(g1, SN_SOLVER_HYBRID, dReal(1e-9), 1) == 1);
  REQUIRE(snGeomSetSolver(g2, SN_SOLVER_HYBRID, dReal(1e-9), 1) == 1);
  const snProximity cut = proximity_of(g1, g2);
  CHECK(cut.evaluations == 1);
  CHECK(cut.converged == 0);
  CHECK(cut.gap <= fine.gap);  // every normal gives a lower bound
  CHECK(fine.gap - cut.gap <= cut.error);
  CHECK(statistics().not_converged == 1);
  CHECK(statistics().out_of_evaluations == 1);
  CHECK(statistics().stalled + statistics().diverged == 0);

  REQUIRE(snGeomSetSolver(g2, SN_SOLVER_HYBRID, 1, 1000) == 1);  // g1: limit 1, tolerance 1e-9
  CHECK(proximity_of(g1, g2).evaluations == fine.evaluations);
  REQUIRE(snGeomSetSolver(g1, SN_SOLVER_HYBRID, 1, 1) == 1);
  CHECK(proximity_of(g1, g2).evaluations < fine.evaluations);
}

TEST_CASE("a pair uses the solver of both geoms, or the hybrid if they differ") {
  OdeSession session;
  snSetWarmStart(0);
  const auto make = [](snSolver solver) {
    REQUIRE(snSetDefaultSolver(solver, dReal(1e-9), 1000) == 1);
    return snCreateEllipsoid(nullptr, 1, dReal(0.8), dReal(0.6));
  };
  const auto evaluations = [&](snSolver solver1, snSolver solver2) {
    const Geom g1(make(solver1));
    const Geom g2(make(solver2));
    place(g2, {1.5, 1.1, 0.9});
    const snProximity p = proximity_of(g1, g2);
    CHECK(p.converged == 1);
    return p.evaluations;
  };
  const int hybrid = evaluations(SN_SOLVER_HYBRID, SN_SOLVER_HYBRID);
  const int fixed_point = evaluations(SN_SOLVER_FIXED_POINT, SN_SOLVER_FIXED_POINT);
  CHECK(fixed_point > hybrid);  // linear against quadratic convergence
  CHECK(evaluations(SN_SOLVER_FIXED_POINT, SN_SOLVER_NEWTON) == hybrid);
  CHECK(evaluations(SN_SOLVER_HYBRID, SN_SOLVER_FIXED_POINT) == hybrid);
}

TEST_CASE("an overlap without convergence gives a contact that separates the geoms") {
  OdeSession session;
  snSetWarmStart(0);
  Random random(22);
  int contacts_seen = 0;
  for (int i = 0; i < 100; ++i) {
    const Geom g1(random_body(random));
    const Geom g2(random_body(random));
    for (const dGeomID g : {dGeomID(g1), dGeomID(g2)}) REQUIRE(snGeomSetSolver(g, SN_SOLVER_HYBRID, dReal(1e-15), 1) == 1);
    place(g2, random.uniform(0.8, 1.2) * random.direction());
    const auto contacts = collide(g1, g2);
    if (contacts.empty()) continue;
    ++contacts_seen;
    CHECK(norm(to_vec(contacts[0].normal)) == relative(1).epsilon(within_rounding(1e-14)));
    move(g1, (1 + 1e-9) * double{contacts[0].depth} * to_vec(contacts[0].normal));
    REQUIRE(snGeomSetSolver(g1, SN_SOLVER_HYBRID, dReal(1e-9), 1000) == 1);
    CHECK(collide(g1, g2).empty());
  }
  CHECK(contacts_seen > 50);
}

TEST_CASE("statistics count the queries of this thread") {
  OdeSession session;
  const Geom g1(snCreateEllipsoid(nullptr, 1, dReal(0.8), dReal(0.6)));
  const Geom g2(snCreateEllipsoid(nullptr, 1, dReal(0.8), dReal(0.6)));
  const Geom sphere(dCreateSphere(nullptr, 1));
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 0));
  place(g2, {1.2, 0.4, 0.3});
  place(sphere, {-1.2, 0.5, 0.2});
  for (int i = 0; i < 3; ++i) {
    collide(g1, g2);
    collide(g1, sphere);
    collide(g1, plane);
  }
  const snStatistics s = statistics();
  CHECK(s.queries_cold == 2);
  CHECK(s.queries_warm == 4);
  CHECK(s.closed_forms == 3);
  CHECK(s.contacts == 9);
  CHECK(s.not_converged == 0);
  CHECK(s.evaluations_cold >= 2 * s.queries_cold);
  CHECK(s.evaluations_warm >= s.queries_warm);
  snResetStatistics();
  CHECK(statistics().queries_cold == 0);
  CHECK(statistics().contacts == 0);
}
