// snGeomProximity, also with every collider: apart, touching, overlapping, in both orders; the solver settings and the statistics.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode/collider_fixture.hpp"
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

// The signed distance from the surface outside, by the formulas of the shapes. Inside, some number that is not positive; on the
// surface 0.
double distance_from(dGeomID collider, const Vec& point) {
  dVector3 local{};
  if (dGeomGetClass(collider) != dPlaneClass) {
    dGeomGetPosRelPoint(collider, dReal(point[0]), dReal(point[1]), dReal(point[2]), local);
  }
  const auto of_box = [](double dx, double dy, double dz) {
    const Vec outside = {std::max(dx, 0.0), std::max(dy, 0.0), std::max(dz, 0.0)};
    return norm(outside) + std::min(std::max({dx, dy, dz}), 0.0);
  };
  dReal radius = 0;
  dReal length = 0;
  dVector3 lengths{};
  dVector4 plane;
  switch (dGeomGetClass(collider)) {
    case dPlaneClass:
      dGeomPlaneGetParams(collider, plane);
      return dot(to_vec(plane), point) - plane[3];
    case dSphereClass:
      return norm(to_vec(local)) - dGeomSphereGetRadius(collider);
    case dBoxClass:
      dGeomBoxGetLengths(collider, lengths);
      return of_box(std::abs(local[0]) - lengths[0] / 2, std::abs(local[1]) - lengths[1] / 2, std::abs(local[2]) - lengths[2] / 2);
    case dCapsuleClass:
      dGeomCapsuleGetParams(collider, &radius, &length);
      local[2] -= std::clamp(local[2], -length / 2, length / 2);
      return norm(to_vec(local)) - radius;
    case dCylinderClass:
      dGeomCylinderGetParams(collider, &radius, &length);
      return of_box(std::hypot(local[0], local[1]) - radius, std::abs(local[2]) - length / 2,
                    -std::numeric_limits<double>::infinity());
    default:
      return -double{snGeomPointDepth(collider, dReal(point[0]), dReal(point[1]), dReal(point[2]))};
  }
}

// There is no formula for a dConvex. A small sphere at the point touches it from the side of the normal.
bool is_on(dGeomID collider, const Vec& point, const Vec& outward) {
  const double tolerance = within_rounding(3e-9);
  if (dGeomGetClass(collider) != dConvexClass) return std::abs(distance_from(collider, point)) < tolerance;
  constexpr double kRadius = 0.01;
  const Geom ball(snCreateEllipsoid(nullptr, dReal(kRadius), dReal(kRadius), dReal(kRadius)));
  place(ball, point + kRadius * outward);
  return std::abs(proximity_of(ball, collider).gap) < tolerance;
}

void check_swapped(dGeomID body, dGeomID collider, const snProximity& forth) {
  const snProximity back = proximity_of(collider, body);
  CHECK(back.gap == forth.gap);
  CHECK(to_vec(back.normal) == -1.0 * to_vec(forth.normal));
  CHECK(to_vec(back.point1) == to_vec(forth.point2));
  CHECK(to_vec(back.point2) == to_vec(forth.point1));
}

void check_answer(dGeomID body, dGeomID collider, const snProximity& answer) {
  const Vec normal = to_vec(answer.normal);
  const Vec d = to_vec(answer.point2) - to_vec(answer.point1);
  CHECK(answer.converged == 1);
  CHECK(answer.error >= 0);
  CHECK(std::abs(norm(normal) - 1) < within_rounding(1e-14));
  CHECK(std::abs(dot(d, normal) - answer.gap) < within_rounding(1e-13));
  CHECK(std::abs(snGeomPointDepth(body, answer.point1[0], answer.point1[1], answer.point1[2])) < within_rounding(3e-9));
  CHECK(is_on(collider, to_vec(answer.point2), -1.0 * normal));
  if (answer.gap > 0) CHECK(norm(d) >= answer.gap - within_rounding(1e-13));
  check_swapped(body, collider, answer);
}

}  // namespace

TEST_CASE_FIXTURE(
    OdeSession,
    "certified: the depth is proved the minimum translation distance, and never larger than the depth of the plain query") {
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

TEST_CASE_FIXTURE(OdeSession,
                  "a pair uses the tighter tolerance and the larger limit, and a query that reaches the limit reports it") {
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

TEST_CASE_FIXTURE(OdeSession, "a pair uses the solver of both geoms, or the hybrid if they differ") {
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

TEST_CASE_FIXTURE(OdeSession, "an overlap without convergence gives a contact that separates the geoms") {
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

TEST_CASE_FIXTURE(OdeSession, "statistics count the queries of this thread") {
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

TEST_CASE_FIXTURE(OdeSession, "proximity: the points are on both surfaces, and a displacement by the gap makes the geoms touch") {
  snSetWarmStart(0);
  for (const ColliderKind kind : kColliderKinds) {
    CAPTURE(name_of(kind));
    Random random(50);
    for (int i = 0; i < 300; ++i) {
      CAPTURE(i);
      const Geom body(random_body(random));
      const ColliderGeom collider(kind, random);
      place(body, random.uniform(3.2, 6) * random.direction());
      const snProximity apart = proximity_of(body, collider);
      if (apart.gap < 0) continue;  // the body is behind a plane
      check_answer(body, collider, apart);
      if (kind == ColliderKind::Plane) CHECK((apart.evaluations == 0 && apart.error == 0));  // explicit
      CHECK(collide(body, collider).empty());

      move(body, double{apart.gap} * to_vec(apart.normal));
      const snProximity touching = proximity_of(body, collider);
      CHECK(std::abs(touching.gap) < within_rounding(3e-9));
      check_answer(body, collider, touching);

      const double depth = random.uniform(0.001, 0.3) * std::min(size_of(body), 0.1);
      move(body, depth * to_vec(apart.normal));
      const snProximity overlapping = proximity_of(body, collider);
      CHECK(overlapping.gap < 0);
      CHECK(overlapping.gap > -depth - within_rounding(3e-9));
      check_answer(body, collider, overlapping);
      const auto contacts = collide(body, collider, 1);
      REQUIRE(contacts.size() == 1);
      CHECK(std::abs(contacts[0].depth + overlapping.gap) < 3e-9);
      CHECK(norm(to_vec(contacts[0].normal) + to_vec(overlapping.normal)) < 1e-4);
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "proximity: geoms without size are points, segments and plates") {
  snSetWarmStart(0);
  Random random(51);
  const Geom point_box(dCreateBox(nullptr, 0, 0, 0));
  const Geom point_capsule(dCreateCapsule(nullptr, 0, 0));
  const Geom point_cylinder(dCreateCylinder(nullptr, 0, 0));
  const Geom point_sphere(dCreateSphere(nullptr, 0));
  const Geom edge_box(dCreateBox(nullptr, 0, 0, 2));
  const Geom edge_capsule(dCreateCapsule(nullptr, 0, 2));
  const Geom edge_cylinder(dCreateCylinder(nullptr, 0, 2));
  const Geom plate(dCreateBox(nullptr, 2, 2, 0));
  const Geom disc(dCreateCylinder(nullptr, 1, 0));
  for (int i = 0; i < 100; ++i) {
    const Geom body(random_body(random));
    place(body, random.uniform(1.6, 4) * random.direction());
    const double depth = snGeomPointDepth(body, 0, 0, 0);
    for (const dGeomID point : {dGeomID(point_box), dGeomID(point_capsule), dGeomID(point_cylinder), dGeomID(point_sphere)}) {
      random.turn(point);
      CHECK(std::abs(proximity_of(body, point).gap + depth) < 3e-9);
      collide(body, point);
    }
    const double to_edge = proximity_of(body, edge_capsule).gap;
    if (to_edge < 0) continue;
    CHECK(to_edge <= -depth + 3e-9);
    for (const dGeomID edge : {dGeomID(edge_box), dGeomID(edge_cylinder)})
      CHECK(std::abs(proximity_of(body, edge).gap - to_edge) < 3e-9);
    for (const dGeomID flat : {dGeomID(plate), dGeomID(disc)}) {
      const snProximity answer = proximity_of(body, flat);
      if (answer.gap > 0) check_answer(body, flat, answer);
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "proximity: geoms with invalid lengths are refused, and collide with nothing") {
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  snProximity answer;
  const dReal infinite = dInfinity;  // a NaN does not get past ODE's assertions
  const Geom box(dCreateBox(nullptr, 1, infinite, 1));
  const Geom capsule(dCreateCapsule(nullptr, infinite, 1));
  const Geom cylinder(dCreateCylinder(nullptr, 1, infinite));
  const Geom sphere(dCreateSphere(nullptr, infinite));
  for (const dGeomID collider : {dGeomID(box), dGeomID(capsule), dGeomID(cylinder), dGeomID(sphere)}) {
    CHECK(collide(body, collider).empty());
    CHECK(refused(snGeomProximity(body, collider, &answer), "inf m is outside [0, 1e+30] m"));
  }
}
