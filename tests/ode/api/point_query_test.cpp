// snGeomPointDepth as a true distance, and snGeomSupport.
#include <doctest/doctest.h>

#include <limits>

#include "support/ode_fixture.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

// A point at signed distance `depth` inside the boundary point with a given normal. Inwards this is exact up to the smallest radius
// of curvature; beyond it another boundary point is nearer.
Vec point_at_depth(dGeomID geom, const Vec& direction, double depth) {
  const dVector3 n = {dReal(direction[0]), dReal(direction[1]), dReal(direction[2]), 0};
  dVector3 boundary;
  REQUIRE(snGeomSupport(geom, n, boundary) == 1);
  return to_vec(boundary) - depth * direction;
}

double depth_of(dGeomID geom, const Vec& p) { return snGeomPointDepth(geom, dReal(p[0]), dReal(p[1]), dReal(p[2])); }

}  // namespace

TEST_CASE("point depth: a sphere has the radius minus the distance") {
  OdeSession session;
  Random random(13);
  const Geom geom(snCreateEllipsoid(nullptr, 2, 2, 2));
  const Geom reference(dCreateSphere(nullptr, 2));
  const Vec centre = {1, -2, 3};
  place(geom, centre);
  place(reference, centre);
  for (int i = 0; i < 300; ++i) {
    const Vec p = centre + random.uniform(0, 10) * random.direction();
    const double expected = dGeomSpherePointDepth(reference, dReal(p[0]), dReal(p[1]), dReal(p[2]));
    CHECK(std::abs(depth_of(geom, p) - expected) < within_rounding(1e-12));
  }
  CHECK(depth_of(geom, centre) == relative(2).epsilon(1e-14));
}

TEST_CASE("point depth: superellipsoids in any pose have the distance along their normals") {
  OdeSession session;
  Random random(14);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const Geom geom(random_body(random));
    place(geom, {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)});
    const Vec n = random.direction();
    const double distance = random.uniform(0, 5);
    CHECK(std::abs(depth_of(geom, point_at_depth(geom, n, -distance)) + distance) < within_rounding(2e-9));
    CHECK(std::abs(depth_of(geom, point_at_depth(geom, n, 0))) < within_rounding(2e-9));
  }
}

TEST_CASE("support: the farthest boundary point is returned for a direction of any length") {
  OdeSession session;
  Random random(16);
  for (int i = 0; i < 100; ++i) {
    const Geom geom(random_body(random));
    place(geom, {4, 5, 6});
    const Vec n = random.direction();
    const Vec farthest = point_at_depth(geom, n, 0);
    for (int k = 0; k < 50; ++k) CHECK(dot(n, point_at_depth(geom, random.direction(), 0)) <= dot(n, farthest) + 1e-13);
    for (const double length : {1e-200, 0.1, 7.0, 1e200}) {
      if (length < double{std::numeric_limits<dReal>::min()} || length > double{std::numeric_limits<dReal>::max()}) continue;
      const dVector3 scaled = {dReal(length * n[0]), dReal(length * n[1]), dReal(length * n[2]), 0};
      dVector3 point;
      REQUIRE(snGeomSupport(geom, scaled, point) == 1);
      CHECK(norm(to_vec(point) - farthest) < within_rounding(1e-13));
    }
  }
}
