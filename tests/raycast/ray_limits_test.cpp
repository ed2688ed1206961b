// Tests of badly conditioned rays: at any scale and place, tangent, along axes, out of range. Boundary points around a line.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "ray_samples.hpp"
#include "raycast/portal.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/draw.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// Draws bodies of every kind, including points, segments and flat hulls. `points` stores the points of a hull.
std::shared_ptr<const Shape> any_shape(RandomRays& random, int k, double size, std::vector<Vector3>& points) {
  const auto length = [&] { return size * random.uniform(0.05, 1); };
  switch (k % 7) {
    case 0:
      return std::make_shared<Box>(Vector3{length(), length(), length()});
    case 1:
      return std::make_shared<Capsule>(k % 2 == 0 ? length() : 0, length());
    case 2:
      return std::make_shared<Cylinder>(length(), length());
    case 3:
      points.clear();
      for (int i = 0; i < 3 + k % 20; ++i) points.emplace_back(size * random.direction());
      return std::make_shared<Polytope>(points);
    case 4:
      return std::make_shared<Superellipsoid>(Vector3{length(), length(), length()}, std::exp(random.uniform(0.01, 6.9)),
                                              std::exp(random.uniform(0.01, 6.9)));
    case 5:
      return std::make_shared<Ellipsoid>(Vector3{length(), length(), length()});
    default:
      return std::make_shared<Sphere>(k % 3 == 0 ? 0 : length());
  }
}

// The view is down along -z. The line is the z-axis, c the origin, d = -r.
const Vector3 kDown = -Vector3::UnitZ();
constexpr double kPortalRounding = 1e-15;

Vector3 beside(double angle, double length) { return length * Vector3(std::cos(angle), std::sin(angle), 0); }

}  // namespace

TEST_CASE("rays: scale, place and orientation change no answer") {
  RandomRays random(160);
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    const Superellipsoid surface = random.shape(kSuperellipsoidClasses[k % 8]);
    const double unit = surface.half_axes().minCoeff();
    const Ray ray = random.past(surface, random.uniform(0, 0.95));
    const RayHit hit = find_ray_hit(surface, {}, ray.origin, ray.direction, kInfinity);
    REQUIRE(hit.hit);
    for (const double scale : {1e-3, 1e3}) {
      const Superellipsoid scaled(scale * surface.half_axes(), surface.delta(), surface.epsilon());
      const RayHit other = find_ray_hit(scaled, {}, scale * ray.origin, ray.direction, kInfinity);
      REQUIRE(other.hit);
      CHECK(std::abs(other.distance / scale - hit.distance) <= other.distance_error / scale + hit.distance_error);
      CHECK((other.point / scale - hit.point).norm() <= other.distance_error / scale + hit.distance_error + 1e-13);
    }
    const Matrix3 R = random.rotation();
    for (const double far : {1.0, 1e4}) {  // m; at this distance the input is rounded to 1e-12 m
      const Pose pose{far * random.direction(), R};
      const RayHit other = find_ray_hit(surface, pose, R * ray.origin + pose.position, R * ray.direction, kInfinity);
      REQUIRE(other.hit);
      const double input_error = 4e-16 * (far + 20) * 4;
      const double along = std::abs(hit.normal.dot(ray.direction));
      const double allowed = other.distance_error + hit.distance_error + input_error / along;
      CHECK(std::abs(other.distance - hit.distance) <= allowed);
      CHECK((R.transpose() * (other.point - pose.position) - hit.point).norm() <= allowed + input_error);
    }
    // The ray starts 1e10 away, as from a program that wants "any distance". The direction is rounded to 1e-6 m there.
    const RayHit far = find_ray_hit(surface, {}, ray.at(-1e10), ray.direction, kInfinity);
    if (far.hit) CHECK(distance_to_boundary(surface, far) <= 1e-9 * unit + 1e-13);
  }
}

TEST_CASE("rays through the centre along the axes hit, although every search direction is degenerate") {
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    CAPTURE(text(shape));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        const Vector3 v = sign * Vector3::Unit(axis);
        const RayHit hit = find_ray_hit(shape, {}, -4 * v, v, kInfinity);
        REQUIRE(hit.hit);
        CHECK(hit.status == Status::Converged);
        CHECK(std::abs(hit.distance - (4 - shape.half_axes()[axis])) <= 1e-9 * shape.half_axes().minCoeff() + 1e-15);
        const RayHit out = find_ray_hit(shape, {}, Vector3::Zero(), v, kInfinity);
        REQUIRE(out.hit);
        CHECK(out.from_inside);
        CHECK(std::abs(out.distance - shape.half_axes()[axis]) <= 1e-9 * shape.half_axes().minCoeff() + 1e-15);
      }
    }
  }
}

TEST_CASE("tangent rays and rays from the boundary hit on the boundary or miss, without a trap") {
  RandomRays random(180);
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    const Superellipsoid surface = random.shape(kSuperellipsoidClasses[k % 8]);
    const double unit = surface.half_axes().minCoeff();
    const Ray tangent = random.past(surface, 1);
    const Ray from_boundary{random.point(surface, 1), random.direction()};
    for (const Ray& ray : {tangent, from_boundary}) {
      const RayHit hit = trapped("a ray", [&] { return find_ray_hit(surface, {}, ray.origin, ray.direction, kInfinity); });
      CHECK(hit.status == Status::Converged);
      if (!hit.hit) continue;
      CHECK(hit.distance >= 0);
      CHECK(distance_to_boundary(surface, hit) <= 1e-9 * unit);
    }
  }
}

TEST_CASE("rays at any shape of any size from anywhere have a valid answer, without a trap") {
  RandomRays random(240);
  std::vector<Vector3> points;
  int hits = 0;
  for (int k = 0; k < 20000; ++k) {
    CAPTURE(k);
    const double size = std::pow(10, random.uniform(-9, 6));
    const auto shape = any_shape(random, k, size, points);
    const Vector3 v = k % 3 == 0 ? Vector3(Vector3::Unit(k % 2)) : random.direction();
    const double away = size * (k % 5 == 0 ? std::pow(10, random.uniform(-20, 12)) : random.uniform(0, 3));
    const Vector3 aim = k % 4 == 0   ? Vector3(Vector3::Zero())
                        : k % 4 == 1 ? Vector3(size * random.uniform(0, 1) * random.direction())
                                     : shape->point(random.direction());
    const double lengths[] = {0, 1e-320, 1e308, kInfinity, away, size};
    const double length = lengths[k % 6];
    const Pose pose{k % 2 == 0 ? Vector3(Vector3::Zero()) : Vector3(1e3 * size * random.direction()), random.rotation()};
    const Vector3 origin = pose.rotation * (aim - away * v) + pose.position;
    const RayHit hit = trapped("a ray", [&] { return find_ray_hit(*shape, pose, origin, pose.rotation * v, length); });
    CHECK(hit.status == Status::Converged);
    if (!hit.hit) continue;
    ++hits;
    CHECK(hit.distance >= 0);
    CHECK(hit.distance <= length + 1e-14 * origin.norm());
    CHECK(hit.distance_error >= 0);
    CHECK(hit.boundary_error >= 0);
    CHECK(hit.point.allFinite());
    CHECK(std::abs(hit.normal.norm() - 1) < 1e-15);
  }
  CHECK(hits > 5000);
}

TEST_CASE("the gap of a sphere and a ray is the distance of the centre from the ray less the radius") {
  RandomRays random(200);
  for (int k = 0; k < 1000; ++k) {
    CAPTURE(k);
    const double radius = random.uniform(0.1, 2);
    const Vector3 centre = random.uniform(0, 5) * random.direction();
    const Vector3 o = random.uniform(0, 5) * random.direction(), v = random.direction();
    for (const double length : {0.0, random.uniform(0, 10), 1e10, kInfinity}) {
      CAPTURE(length);
      const double t = std::clamp((centre - o).dot(v), 0.0, length);
      const double distance = (o + t * v - centre).norm() - radius;
      const bool is_through = t > radius && t < length - radius;
      if (distance < 0 && !is_through) continue;  // the shortest separating translation may lead past the end
      const Proximity result = find_ray_proximity(Sphere(radius), {centre, Matrix3::Identity()}, o, v, length);
      CHECK(result.status == Status::Converged);
      CHECK(std::abs(result.gap - distance) <= 1e-9 * radius);
      CHECK(std::abs((result.point1 - centre).norm() - radius) < 1e-9);
    }
  }
}

TEST_CASE("rays: invalid arguments are refused, and the limit of evaluations is reported") {
  const Superellipsoid shape({1, 0.5, 0.7}, 3, 5);
  const Vector3 o(-3, 0.1, 0.2), v = Vector3(1, 0.02, 0.03).normalized();
  CHECK_THROWS_WITH_AS(find_ray_hit(shape, {}, o, v, -1), "length of the ray = -1 m is outside [0, inf] m", std::invalid_argument);
  CHECK_THROWS_WITH_AS(find_ray_hit(shape, {}, o, 2 * v, 1), doctest::Contains("length of the ray's direction = 2"),
                       std::invalid_argument);
  CHECK_THROWS_AS(find_ray_hit(shape, {}, o, v, std::nan("")), std::invalid_argument);
  Settings settings{.tolerance = 2};
  CHECK_THROWS_AS(find_ray_hit(shape, {}, o, v, 1, settings), std::invalid_argument);

  for (const Vector3& bad : {Vector3(std::nan(""), 0, 0), Vector3(0, kInfinity, 0)}) {
    CHECK(find_ray_hit(shape, {}, bad, v, 1).status == Status::InvalidInput);
    CHECK(find_ray_hit(shape, {}, o, bad, 1).status == Status::InvalidInput);
    CHECK(find_ray_hit(shape, {bad, Matrix3::Identity()}, o, v, 1).status == Status::InvalidInput);
    CHECK_FALSE(find_ray_hit(shape, {}, bad, v, 1).hit);
  }

  CHECK(find_ray_hit(shape, {}, -1e200 * v, v, kInfinity).status == Status::InvalidInput);

  settings = {};
  settings.max_evaluations = 2;
  const RayHit limited = find_ray_hit(shape, {}, o, v, kInfinity, settings);
  CHECK(limited.status == Status::EvaluationLimit);
  CHECK(limited.evaluations == 2);
  const RayHit hit = find_ray_hit(shape, {}, o, v, kInfinity);
  CHECK(hit.status == Status::Converged);
  CHECK(limited.boundary_error > hit.boundary_error);

  settings = {};
  settings.tolerance = 1e-4;
  const RayHit coarse = find_ray_hit(shape, {}, o, v, kInfinity, settings);
  CHECK(coarse.evaluations < hit.evaluations);
  CHECK((coarse.point - hit.point).norm() <= coarse.distance_error);
}

TEST_CASE("portal: points on one side leave a sector of directions that may separate") {
  Portal portal(kDown, kPortalRounding);
  CHECK(portal.sector() == test::relative(2 * std::numbers::pi));
  portal.add(beside(0.3, 2));
  CHECK(portal.sector() == test::relative(std::numbers::pi));
  portal.add(beside(-0.4, 0.5));
  portal.add(beside(0.1, 7));  // between the two others, so it changes nothing
  CHECK_FALSE(portal.is_pierced());
  CHECK(std::isinf(portal.upper_bound()));
  CHECK(portal.sector() == test::relative(std::numbers::pi - 0.7));
  CHECK(portal.bisector().normalized().dot(beside(-0.05, 1)) == test::relative(1));
  CHECK(std::abs(portal.edge_normal().dot(beside(0.3, 2) - beside(-0.4, 0.5))) < 1e-15);
  CHECK(portal.may_separate(portal.edge_normal()));
  CHECK(portal.may_separate(beside(std::numbers::pi / 2 - 0.41, 1)));
  CHECK_FALSE(portal.may_separate(beside(std::numbers::pi / 2 - 0.39, 1)));
  CHECK_FALSE(portal.may_separate(beside(std::numbers::pi, 1)));
}

TEST_CASE("portal: three points around the line, or two on either side of it, are a portal") {
  Portal portal(kDown, kPortalRounding);
  for (const double angle : {0.0, 2.0, 4.0}) {
    CHECK_FALSE(portal.is_pierced());
    portal.add(beside(angle, 1 + angle) - Vector3::UnitZ());  // r at z = 1
  }
  REQUIRE(portal.is_pierced());
  CHECK(portal.upper_bound() == test::relative(-1));  // along -z
  CHECK((portal.normal().normalized() - Vector3::UnitZ()).norm() < 1e-15);

  Portal segment(kDown, kPortalRounding);
  segment.add(Vector3(1, 0, -3));
  segment.add(Vector3(-2, 0, 0));
  REQUIRE(segment.is_pierced());
  CHECK(segment.upper_bound() == test::relative(-2));
  CHECK(std::abs(segment.normal().dot(Vector3(3, 0, -3))) < 1e-15);
  CHECK(segment.normal().dot(kDown) < 0);
}

TEST_CASE("portal: a point on the line is a portal") {
  Portal portal(kDown, kPortalRounding);
  CHECK(portal.add(Vector3(0.5 * kPortalRounding, 0, -2)));
  REQUIRE(portal.is_pierced());
  CHECK(portal.upper_bound() >= -2);
  CHECK(portal.upper_bound() == test::relative(-2));
  CHECK((portal.normal().normalized() + kDown).norm() < 1e-15);
}

// The line passes through a vertex of the triangle or through its middle. The bound includes the rounding of the points.
TEST_CASE("portal: the bound holds for steep portals of rounded points") {
  constexpr double kCoarse = 1e-9;
  Draw draw(6);
  int pierced = 0;
  for (int k = 0; k < 3000; ++k) {
    CAPTURE(k);
    const double steepness = draw.log_uniform(1, 1000);
    const double turn = draw.uniform(0, 2 * std::numbers::pi);
    const Vector3 shift = k % 2 == 0 ? beside(turn, 1) : Vector3(Vector3::Zero());
    Portal portal(kDown, kCoarse);
    for (int i = 0; i < 3; ++i) {
      const Vector3 p = beside(turn + std::numbers::pi + 2.1 * i, 1) + shift;
      const Vector3 off = draw.within(-0.5, 0.5);
      portal.add(Vector3(p.x(), p.y(), steepness * p.x()) + kCoarse * off.normalized());
    }
    if (!portal.is_pierced()) continue;
    ++pierced;
    CHECK(portal.upper_bound() >= 0);
    CHECK(portal.upper_bound() <= 3 * (1 + steepness) * kCoarse);
  }
  CHECK(pierced > 2000);
}

TEST_CASE("portal: each point in front of the portal raises it, and the bound holds") {
  Draw draw(5);
  for (int k = 0; k < 200; ++k) {
    Portal portal(kDown, kPortalRounding);
    double highest = -std::numeric_limits<double>::infinity();  // height of the portal so far
    for (int i = 0; i < 60; ++i) {
      const Vector3 r = draw.direction();  // on the unit sphere
      portal.add(-r);
      if (!portal.is_pierced()) continue;
      const double height = -portal.upper_bound();
      CHECK(height >= highest);
      CHECK(height <= 1);
      highest = height;
      const Vector3 n = portal.normal().normalized();
      CHECK(std::abs(portal.support_bound(n) + n.z() * height) < 1e-12);
    }
    CHECK(portal.is_pierced());
    CHECK(highest > 0);
  }
}
