// Tests of dConvex: its vertices, as read through ODE, at any place.
#include <doctest/doctest.h>

#include <limits>
#include <numbers>

#include "ode/collider_fixture.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "support/relative.hpp"

// dGeomTransform is deprecated in favour of geom offsets, but programs use it and we promise to work inside it.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

using namespace supernormal::test;
using supernormal::Ellipsoid;
using supernormal::Polytope;
using supernormal::Vector3;

namespace {

// The gap to the points themselves, in the geom's frame, as the reference.
double gap_to_points(const Vector3& half_axes, dGeomID body, const std::vector<Vec>& points, dGeomID convex) {
  std::vector<Vector3> vertices;
  vertices.reserve(points.size());
  for (const Vec& p : points) vertices.emplace_back(p[0], p[1], p[2]);
  return find_proximity(Ellipsoid(half_axes), pose_of(body), Polytope(vertices), pose_of(convex)).gap;
}

std::vector<Vec> box_corners(double x, double y, double z) {
  std::vector<Vec> corners;
  for (unsigned k = 0; k < 8; ++k) corners.push_back({(k & 1U) != 0 ? x : -x, (k & 2U) != 0 ? y : -y, (k & 4U) != 0 ? z : -z});
  return corners;
}

// Points on a golden spiral.
std::vector<Vec> sphere_points(int count) {
  std::vector<Vec> points;
  for (int k = 0; k < count; ++k) {
    const double z = (2 * k + 1.0) / count - 1;
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const double across = std::sqrt(1 - z * z);
    points.push_back({across * std::cos(angle), across * std::sin(angle), z});
  }
  return points;
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "dConvex: all vertices are found in any pose") {
  Random random(30);
  const Vector3 axes(0.7, 0.5, 0.9);
  const Geom body(snCreateEllipsoid(nullptr, dReal(axes.x()), dReal(axes.y()), dReal(axes.z())));
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    auto points = random_hull(random);
    if (i % 3 == 1) {  // far from the geom's own origin
      for (Vec& p : points) p = p + Vec{3, -20, 7};
    }
    const ConvexGeom convex(points);
    const double distance = i % 5 == 4 ? 1000 : 3;
    place(convex, {random.uniform(-distance, distance), random.uniform(-distance, distance), random.uniform(-distance, distance)});
    if (i % 4 != 3) random.turn(convex);  // otherwise many vertices are on the plane by which they are listed
    // The body is next to a vertex, so that this vertex matters.
    const Vec& vertex = points[static_cast<std::size_t>(i) % points.size()];
    dVector3 world;
    dGeomGetRelPointPos(convex, dReal(vertex[0]), dReal(vertex[1]), dReal(vertex[2]), world);
    place(body, to_vec(world) + random.uniform(0.4, 2) * random.direction());
    random.turn(body);
    const snProximity found = proximity_of(body, convex);
    const double expected = gap_to_points(axes, body, points, convex);
    if (expected > -0.1) CHECK(std::abs(found.gap - expected) < within_rounding(1e-9, 10 + distance));
  }
}

TEST_CASE_FIXTURE(
    OdeSession,
    "dConvex: inside a moving dGeomTransform the vertices are found, although ODE's bounding box is of an earlier pose") {
  snSetWarmStart(0);
  Random random(32);
  const auto points = random_hull(random);
  const ConvexArrays arrays(points);
  const ConvexGeom direct(points);
  const Geom transform(dCreateGeomTransform(nullptr));
  const dGeomID inner = arrays.create(nullptr);
  dGeomTransformSetCleanup(transform, 1);
  dGeomTransformSetGeom(transform, inner);
  const Geom body(snCreateSuperellipsoid(nullptr, 1, dReal(0.7), dReal(0.5), 3, 6));
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    const double far = i % 2 == 0 ? 0 : 50;
    const Vec where = {far + random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    random.turn(transform);
    dGeomSetRotation(direct, dGeomGetRotation(transform));
    place(transform, where);
    place(direct, where);
    place(body, {far, 0, 0});
    random.turn(body);
    const auto expected = collide(body, direct);
    touching += static_cast<int>(expected.size());
    CHECK(same_bits(collide(body, transform), expected));  // a function of the poses, to the last bit
  }
  CHECK(touching > 100);
}

TEST_CASE_FIXTURE(OdeSession,
                  "dConvex: the next query after dGeomSetConvex sees the new vertices, also with an outdated bounding box") {
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  const ConvexArrays small(box_corners(0.1, 0.1, 0.1));
  const ConvexArrays large(box_corners(1, 1, 1));
  auto far_corners = box_corners(1, 1, 1);
  for (Vec& p : far_corners) p = p + Vec{5, 0, 0};
  const ConvexArrays far(far_corners);
  const dGeomID body = snCreateEllipsoid(space, 1, 1, 1);
  place(body, {1.5, 0, 0});
  for (const dGeomID convex : {small.create(nullptr), small.create(space)}) {
    dReal aabb[6];
    dGeomGetAABB(convex, aabb);
    CHECK(proximity_of(body, convex).gap == relative(0.4));
    large.give_to(convex);
    CHECK(proximity_of(body, convex).gap == relative(-0.5));  // the old box is within the new one
    far.give_to(convex);
    snProximity answer;
    if (dGeomGetSpace(convex) != nullptr) {
      CHECK(refused(snGeomProximity(body, convex, &answer), "dGeomMoved"));
      dSpaceCollide(space, nullptr, [](void*, dGeomID g1, dGeomID g2) { CHECK(collide(g1, g2).empty()); });
      dGeomMoved(convex);
    }
    CHECK(proximity_of(body, convex).gap == relative(1.5));
    dGeomDestroy(convex);
  }
  dSpaceDestroy(space);
}

TEST_CASE_FIXTURE(OdeSession, "dConvex: coplanar, repeated, collinear, few and many points are valid") {
  Random random(33);
  std::vector<Vec> grid;
  for (int x = -3; x <= 3; ++x) {
    for (int y = -3; y <= 3; ++y) {
      for (int z = -3; z <= 3; ++z) grid.push_back({x / 3.0, y / 3.0, z / 3.0});
    }
  }
  auto twice = box_corners(1, 1, 1);
  twice.insert(twice.end(), twice.begin(), twice.begin() + 8);
  const std::vector<Vec> square = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<Vec> segment = {{0, 0, -1}, {0, 0, 0.2}, {0, 0, 1}};
  const Geom cube(dCreateBox(nullptr, 2, 2, 2));
  const Geom plate(dCreateBox(nullptr, 2, 2, 0));
  const Geom needle(dCreateCapsule(nullptr, 0, 2));
  const Geom ball(dCreateSphere(nullptr, 1));
  struct Case {
    const char* name;
    std::vector<Vec> points;
    dGeomID same_as;
    double tolerance;
  };
  const Case cases[] = {{"a grid of 343 points", grid, cube, 2e-9},
                        {"every corner twice", twice, cube, 2e-9},
                        {"a square", square, plate, 2e-9},
                        {"a segment", segment, needle, 2e-9},
                        {"8192 points", sphere_points(8192), ball, 1e-3}};
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const ConvexGeom convex(c.points);
    for (int i = 0; i < 60; ++i) {
      CAPTURE(i);
      random.turn(convex);
      dGeomSetRotation(c.same_as, dGeomGetRotation(convex));
      const Geom body(random_body(random));
      overlap(body, convex, random.uniform(-0.5, 0.15), random);
      CHECK(std::abs(proximity_of(body, convex).gap - proximity_of(body, c.same_as).gap) < within_rounding(c.tolerance));
      for (const dContactGeom& contact : collide(body, convex))
        CHECK(std::abs(norm(to_vec(contact.normal)) - 1) < within_rounding(1e-14));
    }
  }
  const ConvexGeom point({{0.5, 0, 0}, {0.5, 0, 0}});
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  for (int i = 0; i < 20; ++i) {
    random.turn(point);
    place(body, random.uniform(0, 3) * random.direction());
    dVector3 world;
    dGeomGetRelPointPos(point, dReal(0.5), 0, 0, world);
    const double depth = snGeomPointDepth(body, world[0], world[1], world[2]);
    CHECK(std::abs(proximity_of(body, point).gap + depth) < 2e-9);
  }
}

TEST_CASE_FIXTURE(OdeSession, "dConvex: more vertices than dCollide can list, and vertices that are not finite, are refused") {
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  snProximity answer;
  const ConvexGeom most(std::vector<Vec>(65534, Vec{0.5, 0, 0}));
  CHECK(snGeomProximity(body, most, &answer) == 1);
  const ConvexGeom many(std::vector<Vec>(65535, Vec{0.5, 0, 0}));
  CHECK(refused(snGeomProximity(body, many, &answer), "65534"));
  CHECK(collide(body, many).empty());
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    auto points = box_corners(1, 1, 1);
    for (Vec& p : points) p[1] = bad;
    const ConvexGeom convex(points);
    CHECK(snGeomProximity(body, convex, &answer) == 0);
    CHECK(collide(body, convex).empty());
  }
  const ConvexGeom huge(box_corners(1e35, 1, 1));
  CHECK(refused(snGeomProximity(body, huge, &answer), "is outside"));
}
