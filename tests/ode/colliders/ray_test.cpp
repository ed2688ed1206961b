// Tests of dRay: ODE's conventions, and its own battery for rays (demo_collision.cpp, test_ray_and_sphere) for our bodies.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

void aim(dGeomID ray, const Vec& origin, const Vec& direction, double length) {
  dGeomRaySet(ray, dReal(origin[0]), dReal(origin[1]), dReal(origin[2]), dReal(direction[0]), dReal(direction[1]),
              dReal(direction[2]));
  dGeomRaySetLength(ray, dReal(length));
}

Vec support(dGeomID geom, const Vec& n) {
  const dVector3 direction = {dReal(n[0]), dReal(n[1]), dReal(n[2]), 0};
  dVector3 point;
  REQUIRE(snGeomSupport(geom, direction, point) == 1);
  return to_vec(point);
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

Vec orthogonal(Random& random, const Vec& n) {
  const Vec v = random.direction();
  const Vec t = v - dot(v, n) * n;
  return (1 / norm(t)) * t;
}

/// Draws a body with exponents 1.02...200 and aspect ratios up to 100. Some are ellipsoids or rounded bodies.
dGeomID any_body(Random& random, int k) {
  const auto between = [&](double low, double high) { return dReal(std::exp(random.uniform(std::log(low), std::log(high)))); };
  const bool is_needle = k % 4 == 0;
  const dReal a = is_needle ? between(0.05, 5) : between(0.5, 1.5);
  const dReal b = is_needle ? between(0.05, 5) : between(0.5, 1.5);
  const dReal c = is_needle ? between(0.05, 5) : between(0.5, 1.5);
  const dReal delta = between(1.02, 200);
  const dReal epsilon = between(1.02, 200);
  const dGeomID geom = k % 5 == 0 ? snCreateEllipsoid(nullptr, a, b, c) : snCreateSuperellipsoid(nullptr, a, b, c, delta, epsilon);
  if (k % 7 == 0) snGeomSetRounding(geom, dReal(0.05));
  place(geom, {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)});
  random.turn(geom);
  return geom;
}

/// m, along the axes of the body; tolerances are relative to these lengths
double least_half_extent(dGeomID body) {
  const dReal* const R = dGeomGetRotation(body);
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec direction = {R[axis], R[4 + axis], R[8 + axis]};
    least = std::min(least, dot(support(body, direction) - centre_of(body), direction));
  }
  return least;
}

/// Checks that the hit is on the boundary by the plane with the contact's own normal, beyond which there is no body. The distance
/// of the point would not do: in an overlap it has several local maxima.
void check_on_boundary(dGeomID body, const dContactGeom& contact, const Vec& direction) {
  const Vec pos = to_vec(contact.pos);
  const bool is_from_inside =
      dot(to_vec(contact.normal), support(body, to_vec(contact.normal)) - pos) > 1e-3 && dot(to_vec(contact.normal), direction) < 0;
  const Vec outward = is_from_inside ? -1.0 * to_vec(contact.normal) : to_vec(contact.normal);
  CHECK(std::abs(dot(outward, support(body, outward) - pos)) < within_rounding(1e-9));
  CHECK(snGeomPointDepth(body, contact.pos[0], contact.pos[1], contact.pos[2]) > -within_rounding(1e-9));
}

}  // namespace

TEST_CASE("rays hit a spherical body as they hit a dSphere, from outside and inside") {
  OdeSession session;
  Random random(31);
  const Geom ray(dCreateRay(nullptr, 1));
  int outside = 0, inside = 0, none = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    CAPTURE(i);
    const double radius = random.uniform(0.1, 2);
    const auto r = dReal(radius);
    const Geom theirs(dCreateSphere(nullptr, r));
    const Geom ours(i % 2 == 0 ? snCreateEllipsoid(nullptr, r, r, r) : snCreateSuperellipsoid(nullptr, r / 2, r / 2, r / 2, 2, 2));
    if (i % 2 == 1) snGeomSetRounding(ours, r / 2);
    const Vec where = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    place(ours, where);
    place(theirs, where);
    random.turn(ours);
    const Vec start = where + random.uniform(0, 2.5) * radius * random.direction();
    aim(ray, start, random.direction(), random.uniform(0, 4 * radius));

    // If ODE's own formula loses digits, no comparison is possible.
    const Vec q = start - where;
    dVector3 at, along;
    dGeomRayGet(ray, at, along);
    const double B = dot(q, to_vec(along)), C = dot(q, q) - radius * radius;
    if (std::abs(B * B - C) < 1e-6 * radius * radius || std::abs(C) < 1e-9) continue;

    for (const bool ray_first : {true, false}) {
      const auto reference = ray_first ? collide(ray, theirs) : collide(theirs, ray);
      const auto found = ray_first ? collide(ray, ours) : collide(ours, ray);
      REQUIRE(found.size() == reference.size());
      if (found.empty()) {
        ++none;
        continue;
      }
      ++(C < 0 ? inside : outside);
      CHECK(std::abs(found[0].depth - reference[0].depth) < within_rounding(1e-9));
      CHECK(norm(to_vec(found[0].normal) - to_vec(reference[0].normal)) < within_rounding(1e-9));
      CHECK(norm(to_vec(found[0].pos) - to_vec(reference[0].pos)) < within_rounding(1e-9));
    }
  }
  CHECK(outside > draws(1000));
  CHECK(inside > draws(1000));
  CHECK(none > draws(1000));
}

TEST_CASE("ODE's ray battery for our bodies") {
  OdeSession session;
  Random random(32);
  const Geom ray(dCreateRay(nullptr, 0));
  int hits = 0;
  for (int k = 0; k < kRepetitions; ++k) {
    CAPTURE(k);
    const Geom body(any_body(random, k));
    const Vec c = centre_of(body);
    const Vec n = random.direction();
    const Vec p = support(body, n);  // the boundary point with normal n
    const auto scaled = [&](double share) { return c + share * (p - c); };

    // The ray has length zero, just inside and just outside.
    aim(ray, scaled(0.99), random.direction(), 0);
    CHECK(hit(ray, body).empty());
    aim(ray, scaled(1.01), random.direction(), 0);
    CHECK(hit(ray, body).empty());

    // The ray is wholly inside.
    const Vec q1 = scaled(0.99 * random.uniform(0, 1));
    const Vec q2 = c + 0.99 * random.uniform(0, 1) * (support(body, random.direction()) - c);
    aim(ray, q1, q2 - q1, norm(q2 - q1));
    CHECK(hit(ray, body).empty());

    // The ray is wholly outside and points away.
    Vec away = random.direction();
    if (dot(away, n) < 0) away = -1.0 * away;
    aim(ray, scaled(1.01), away, 100);
    CHECK(hit(ray, body).empty());

    // The ray goes from outside towards the centre. It is too short by 0.01 %, then long enough by as much.
    const double distance = random.uniform(0.5, 2);
    const Vec inward = (1 / norm(c - p)) * (c - p);
    aim(ray, p - distance * inward, inward, 0.9999 * distance);
    CHECK(hit(ray, body).empty());
    dGeomRaySetLength(ray, dReal(1.0001 * distance));
    const auto frontal = hit(ray, body);
    REQUIRE(frontal.size() == 1);
    // The hit is within the documented distance of the boundary. Along the ray the error is larger as the ray grazes the surface.
    const double tolerance = within_rounding(1e-9 * least_half_extent(body)) / std::abs(dot(inward, n));
    CHECK(norm(to_vec(frontal[0].pos) - p) < tolerance);
    CHECK(std::abs(frontal[0].depth - distance) < tolerance);

    // Random rays start inside and outside.
    const Vec direction = random.direction();
    aim(ray, scaled(random.uniform(0.5, 1.5)), direction, 100);
    const auto random_hit = hit(ray, body);
    if (!random_hit.empty()) {
      ++hits;
      CHECK(dot(direction, to_vec(random_hit[0].normal)) <= 1e-15);
      check_on_boundary(body, random_hit[0], direction);
    }

    // Tangential rays graze past and into the body.
    const Vec tangent = orthogonal(random, n);
    aim(ray, scaled(1.01) - 10.0 * tangent, tangent, 20);
    CHECK(hit(ray, body).empty());
    aim(ray, scaled(0.99) - 10.0 * tangent, tangent, 20);
    CHECK(hit(ray, body).size() == 1);
  }
  CHECK(hits > kRepetitions / 2);
}

TEST_CASE("rays of any valid length hit, and rays of invalid length do not") {
  OdeSession session;
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

TEST_CASE("a ray hits the same when set by dGeomRaySet, by its pose or by a body with an offset") {
  OdeSession session;
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
    for (const dGeomID other : {dGeomID(set), dGeomID(carried)}) {
      const auto contacts = hit(other, body);
      REQUIRE(contacts.size() == 1);
      CHECK(std::abs(contacts[0].depth - reference[0].depth) < within_rounding(1e-12));
      CHECK(norm(to_vec(contacts[0].pos) - to_vec(reference[0].pos)) < within_rounding(1e-12));
    }
  }
}

namespace {

struct Nearest {
  double depth = std::numeric_limits<double>::infinity();
  dGeomID geom = nullptr;
  int hits = 0;
};

void keep_nearest(void* data, dGeomID g1, dGeomID g2) {
  auto& nearest = *static_cast<Nearest*>(data);
  dContactGeom contact;
  if (dCollide(g1, g2, 1, &contact, sizeof contact) == 0) return;
  ++nearest.hits;
  if (contact.depth >= nearest.depth) return;
  nearest.depth = contact.depth;
  nearest.geom = dGeomGetClass(g1) == dRayClass ? g2 : g1;
}

}  // namespace

TEST_CASE("a ray finds the same bodies in every kind of space as by single calls") {
  OdeSession session;
  const dVector3 centre = {0, 0, 0, 0}, extents = {20, 20, 20, 0};
  for (int kind = 0; kind < 4; ++kind) {
    CAPTURE(kind);
    const dSpaceID space = kind == 0   ? dSimpleSpaceCreate(nullptr)
                           : kind == 1 ? dHashSpaceCreate(nullptr)
                           : kind == 2 ? dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)
                                       : dQuadTreeSpaceCreate(nullptr, centre, extents, 4);
    Random random(34);
    std::vector<dGeomID> bodies;
    for (int i = 0; i < 100; ++i) {
      bodies.push_back(random_body(random, space));
      place(bodies.back(), {random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(-8, 8)});
    }
    const Geom ray(dCreateRay(nullptr, 1));
    int found = 0;
    for (int k = 0; k < 200; ++k) {
      CAPTURE(k);
      const Vec v = random.direction();
      aim(ray, 3.0 * random.direction() - 15.0 * v, v, k % 2 == 0 ? 1e10 : 30);
      Nearest one_by_one, by_space;
      for (const dGeomID body : bodies) keep_nearest(&one_by_one, ray, body);
      dSpaceCollide2(ray, reinterpret_cast<dGeomID>(space), &by_space, keep_nearest);
      CHECK(by_space.hits == one_by_one.hits);
      CHECK(by_space.geom == one_by_one.geom);
      CHECK((by_space.geom == nullptr || by_space.depth == one_by_one.depth));
      found += by_space.hits;
    }
    CHECK(found > 200);
    dSpaceDestroy(space);
  }
}

TEST_CASE("a ray with any max_contacts is counted in the statistics") {
  OdeSession session;
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

TEST_CASE("snGeomProximity of a body and a ray returns the distance of the segment") {
  OdeSession session;
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
    snProximity answer;
    REQUIRE(snGeomProximity(ray, body, &answer) == 1);
    CHECK(std::abs(answer.gap - gap) < within_rounding(1e-9));
    CHECK(norm(to_vec(answer.point1) - nearest) < 1e-4);
    CHECK(dot(to_vec(answer.normal), c - nearest) > 0);
    REQUIRE(snGeomProximity(body, ray, &answer) == 1);
    CHECK(std::abs(answer.gap - gap) < within_rounding(1e-9));
  }
}
