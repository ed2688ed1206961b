// Tests of dRay: ODE's conventions.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

void aim(dGeomID ray, const Vec& origin, const Vec& direction, double length) {
  dGeomRaySet(ray, dReal(origin[0]), dReal(origin[1]), dReal(origin[2]), dReal(direction[0]), dReal(direction[1]),
              dReal(direction[2]));
  dGeomRaySetLength(ray, dReal(length));
}

Vec centre_of(dGeomID geom) { return to_vec(dGeomGetPosition(geom)); }

/// Collides in both call orders, which must agree. Returns the contact of dCollide(ray, body).
std::vector<dContactGeom> hit(dGeomID ray, dGeomID body) {
  auto contacts = collide(ray, body);
  const auto turned = collide(body, ray);
  REQUIRE(contacts.size() == turned.size());
  REQUIRE(contacts.size() <= 1);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    CHECK(contacts[i].g1 == ray);
    CHECK(contacts[i].g2 == body);
    CHECK(turned[i].g1 == body);
    CHECK(turned[i].g2 == ray);
    CHECK(norm(to_vec(contacts[i].normal) + to_vec(turned[i].normal)) == 0);
    CHECK(norm(to_vec(contacts[i].pos) - to_vec(turned[i].pos)) == 0);
    CHECK(contacts[i].depth == turned[i].depth);
    CHECK(contacts[i].side1 == -1);
    CHECK(contacts[i].side2 == -1);
    CHECK(std::abs(norm(to_vec(contacts[i].normal)) - 1) < within_rounding(1e-15));
  }
  return contacts;
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "rays of any valid length hit, and rays of invalid length do not") {
  const Geom body(snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.5), 4, 3));
  const Geom ray(dCreateRay(nullptr, 0));
  for (const double length : {6.0, 1e10, 1e300, std::numeric_limits<double>::infinity()}) {
    CAPTURE(length);
    aim(ray, {-5, 0, 0}, {1, 0, 0}, length);
    const auto contacts = hit(ray, body);
    REQUIRE(contacts.size() == 1);
    CHECK(std::abs(contacts[0].depth - 4) < 1e-9);
    CHECK(norm(to_vec(contacts[0].normal) - Vec{-1, 0, 0}) < 1e-9);
  }
  for (const double length : {0.0, -1.0, 3.9, std::nan("")}) {
    CAPTURE(length);
    aim(ray, {-5, 0, 0}, {1, 0, 0}, length);
    CHECK(hit(ray, body).empty());
  }
  // Also from inside the normal opposes the ray.
  aim(ray, {0, 0, 0}, {1, 0, 0}, 2);
  const auto contacts = hit(ray, body);
  REQUIRE(contacts.size() == 1);
  CHECK(std::abs(contacts[0].depth - 1) < 1e-9);
  CHECK(norm(to_vec(contacts[0].normal) - Vec{-1, 0, 0}) < 1e-9);
}

TEST_CASE_FIXTURE(OdeSession, "a ray hits the same when set by dGeomRaySet, by its pose or by a body with an offset") {
  Random random(33);
  const World world;
  for (int k = 0; k < 300; ++k) {
    CAPTURE(k);
    const Geom body(random_body(random));
    place(body, {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)});
    const Geom turned(dCreateRay(nullptr, 20));
    random.turn(turned);
    const dReal* const R = dGeomGetRotation(turned);
    const Vec v = {double{R[2]}, double{R[6]}, double{R[10]}};
    const Vec start = centre_of(body) + 0.4 * random.direction() - 5.0 * v;
    place(turned, start);
    const Geom set(dCreateRay(nullptr, 20));
    aim(set, start, v, 20);
    const dBodyID carrier = dBodyCreate(world.id());
    const Geom carried(dCreateRay(nullptr, 20));
    dGeomSetBody(carried, carrier);
    const Vec offset = random.direction();
    dBodySetPosition(carrier, dReal(start[0] - offset[0]), dReal(start[1] - offset[1]), dReal(start[2] - offset[2]));
    dGeomSetOffsetPosition(carried, dReal(offset[0]), dReal(offset[1]), dReal(offset[2]));
    dGeomSetOffsetRotation(carried, R);

    const auto reference = hit(turned, body);
    REQUIRE(reference.size() == 1);
    const dReal* const at = reference[0].pos;
    CHECK(std::abs(snGeomPointDepth(body, at[0], at[1], at[2])) < within_rounding(3e-9, 10));
    CHECK(norm(to_vec(at) - (start + double{reference[0].depth} * v)) < within_rounding(1e-9, 10));
    CHECK(dot(to_vec(reference[0].normal), v) < 0);
    for (const dGeomID other : {dGeomID(set), dGeomID(carried)}) {
      const auto contacts = hit(other, body);
      REQUIRE(contacts.size() == 1);
      CHECK(std::abs(contacts[0].depth - reference[0].depth) < within_rounding(1e-12));
      CHECK(norm(to_vec(contacts[0].pos) - to_vec(reference[0].pos)) < within_rounding(1e-12));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "a ray with any max_contacts is counted in the statistics") {
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom ray(dCreateRay(nullptr, 10));
  aim(ray, {-3, 0.5, 0}, {1, 0, 0}, 10);
  snResetStatistics();
  CHECK(collide(ray, body, 1).size() == 1);
  CHECK(collide(body, ray, 100).size() == 1);
  aim(ray, {-3, 1.5, 0}, {1, 0, 0}, 10);
  CHECK(collide(ray, body).empty());
  snStatistics statistics;
  snGetStatistics(&statistics);
  CHECK(statistics.queries_cold == 3);
  CHECK(statistics.evaluations_cold == 3);  // an ellipsoid needs one evaluation for each query
  CHECK(statistics.contacts == 2);
  CHECK(statistics.not_converged == 0);
}

TEST_CASE_FIXTURE(OdeSession, "snGeomProximity of a body and a ray returns the distance of the segment") {
  Random random(35);
  const Geom ray(dCreateRay(nullptr, 1));
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    const double radius = random.uniform(0.2, 2);
    const Geom body(snCreateEllipsoid(nullptr, dReal(radius), dReal(radius), dReal(radius)));
    const Vec c = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    place(body, c);
    const Vec start = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
    const double length = k % 3 == 0 ? 1e10 : random.uniform(0, 8);
    aim(ray, start, random.direction(), length);
    dVector3 at, along;
    dGeomRayGet(ray, at, along);
    const double t = std::min(std::max(dot(c - start, to_vec(along)), 0.0), length);
    const Vec nearest = start + t * to_vec(along);
    const double gap = norm(nearest - c) - radius;
    if (gap < 0) continue;
    const snProximity answer = proximity_of(ray, body);
    CHECK(std::abs(answer.gap - gap) < within_rounding(1e-9));
    CHECK(norm(to_vec(answer.point1) - nearest) < 1e-4);
    CHECK(dot(to_vec(answer.normal), c - nearest) > 0);
    CHECK(std::abs(proximity_of(body, ray).gap - gap) < within_rounding(1e-9));
  }
}
