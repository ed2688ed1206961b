// Tests of rays against the core's shapes.
#include "supernormal/raycast/ray.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "ray_samples.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/draw.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

const int kRaysPerClass = at_length() ? 2000 : 300;

/// Checks the conditions on every hit of a superellipsoid, against the implicit equation.
void check_hit(const Superellipsoid& shape, const Ray& ray, const RayHit& hit, double expected, double normal_tolerance,
               double boundary_tolerance = 1e-9) {
  const double unit = shape.half_axes().minCoeff();
  const double size = shape.half_axes().maxCoeff();
  CHECK(std::abs(hit.normal.norm() - 1) <= 4e-16);
  CHECK((ray.at(hit.distance) - hit.point).norm() <= 1e-14 * (size + hit.distance));
  CHECK(hit.distance_error >= 0);
  const double along = std::abs(hit.normal.dot(ray.direction));
  CHECK((hit.from_inside ? hit.normal.dot(ray.direction) > 0 : hit.normal.dot(ray.direction) < 0));

  CHECK(distance_to_boundary(shape, hit) <= std::min(hit.boundary_error, boundary_tolerance * unit) + 1e-15 * size);
  CHECK(hit.boundary_error <= boundary_tolerance * unit);
  // The distance agrees with the implicit equation, up to the equation's rounding.
  CHECK(std::abs(hit.distance - expected) <= hit.distance_error + 1e-14 * (size + hit.distance) / along);
  // The normal is the normal at the point. On a sharp edge, its boundary point is the hit.
  const double turned = (level_normal(shape, hit.point) - hit.normal).norm();
  CHECK(std::min(turned, (shape.point(hit.normal) - hit.point).norm() / unit) <= normal_tolerance);
}

/// Checks that no point of the body is in front of the hit.
void check_nothing_before(const Superellipsoid& shape, const Ray& ray, const RayHit& hit) {
  double least = kInfinity;
  for (int halving = 1; halving < 24; ++halving)
    least = std::min(least, gauge(shape, ray.at((1 - std::ldexp(1, -halving)) * hit.distance)));
  for (int percent = 0; percent < 100; ++percent) least = std::min(least, gauge(shape, ray.at(0.01 * percent * hit.distance)));
  CHECK(least >= 1 - 1e-13);
}

/// Calls check(random, body, shape) for `count` bodies of each class; the shape is the body as a program makes it.
void for_bodies(unsigned seed, int count, const auto& check) {
  for (const SuperellipsoidClass& kind : kSuperellipsoidClasses) {
    RandomRays random(++seed);
    for (int k = 0; k < count; ++k) {
      CAPTURE(kind.name);
      CAPTURE(k);
      const Superellipsoid body = random.shape(kind);
      check(random, body, *make_shape(body));
    }
  }
}

}  // namespace

TEST_CASE("rays at spheres and ellipsoids have the closed form, from outside, inside and behind") {
  RandomRays random(1);
  int outside = 0, inside = 0, none = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vector3 a{random.uniform(0.1, 3), random.uniform(0.1, 3), random.uniform(0.1, 3)};
    const bool is_sphere = k % 2 == 0;
    const Vector3 axes = is_sphere ? Vector3::Constant(a.x()) : a;
    const Vector3 v = random.direction();
    const Vector3 o = random.uniform(0, 5) * random.direction();
    const double length = random.uniform(0, 10);
    const RayHit hit = is_sphere ? find_ray_hit(Sphere(a.x()), {}, o, v, length) : find_ray_hit(Ellipsoid(axes), {}, o, v, length);

    // The hit is at |(o + t v) / axes|^2 = 1.
    const Vector3 p = o.cwiseQuotient(axes), q = v.cwiseQuotient(axes);
    const double A = q.squaredNorm(), B = p.dot(q), C = p.squaredNorm() - 1;
    const double discriminant = B * B - A * C;
    if (std::abs(discriminant) < 1e-6 || std::abs(C) < 1e-6) continue;
    const double root = std::sqrt(std::max(discriminant, 0.0));
    const double t = C < 0 ? (-B + root) / A : (-B - root) / A;
    const bool expected = discriminant > 0 && t >= 0 && t <= length;
    CHECK(hit.status == Status::Converged);
    REQUIRE(hit.hit == expected);
    if (!expected) {
      ++none;
      continue;
    }
    ++(C < 0 ? inside : outside);
    CHECK(hit.from_inside == (C < 0));
    CHECK(std::abs(hit.distance - t) < 1e-10);
    const Vector3 x = o + t * v;
    CHECK((hit.point - x).norm() < 1e-10);
    CHECK((hit.normal - x.cwiseQuotient(axes).cwiseQuotient(axes).normalized()).norm() < 1e-8);
    CHECK(hit.evaluations <= 2);
  }
  CHECK(outside > 200);
  CHECK(inside > 200);
  CHECK(none > 1000);
}

TEST_CASE(
    "rays at superellipsoids: the hit is on the surface, nothing is before it, and the normal is right, by the implicit equation") {
  unsigned seed = 20;
  double means = 0, means_of_bare = 0;
  for (const SuperellipsoidClass& kind : kSuperellipsoidClasses) {
    RandomRays random(++seed);
    long evaluations = 0, evaluations_of_bare = 0;
    int most = 0;
    for (int k = 0; k < kRaysPerClass; ++k) {
      const Superellipsoid surface = random.shape(kind);
      const auto shape = make_shape(surface);
      const Ray ray = random.past(surface, random.uniform(0, 0.99));
      const std::string name = std::string(kind.name) + " " + std::to_string(k);
      CAPTURE(name);
      const RayHit hit = trapped("a ray", [&] { return find_ray_hit(*shape, {}, ray.origin, ray.direction, kInfinity); });
      REQUIRE(hit.hit);
      CHECK_FALSE(hit.from_inside);
      CHECK(hit.status == Status::Converged);
      const double entry = find_crossings(surface, ray).entry;
      check_hit(surface, ray, hit, entry, 1e-8);
      check_nothing_before(surface, ray, hit);
      evaluations += hit.evaluations;
      most = std::max(most, hit.evaluations);
      const CallbackShape bare = without_hessian(shape);
      const RayHit of_bare = find_ray_hit(bare, {}, ray.origin, ray.direction, kInfinity);
      REQUIRE(of_bare.hit);
      CHECK(of_bare.status == Status::Converged);
      check_hit(surface, ray, of_bare, entry, 1e-4, 1e-6);
      check_nothing_before(surface, ray, of_bare);
      evaluations_of_bare += of_bare.evaluations;
      const Ray outer = random.past(surface, 1 + 1e-9);
      CHECK_FALSE(find_ray_hit(bare, {}, outer.origin, outer.direction, kInfinity).hit);
    }
    MESSAGE(std::string(kind.name), ": evaluations ", double(evaluations) / kRaysPerClass, " on average, at most ", most,
            "; without a Hessian ", double(evaluations_of_bare) / kRaysPerClass);
    means += double(evaluations) / kRaysPerClass;
    means_of_bare += double(evaluations_of_bare) / kRaysPerClass;
  }
  CHECK(means <= 36);
  CHECK(means_of_bare <= 160);
}

TEST_CASE("grazing rays hit or miss rightly down to one part in 1e9") {
  for_bodies(40, kRaysPerClass / 4, [](RandomRays& random, const Superellipsoid& surface, const Shape& shape) {
    for (const double share : {0.01, 1e-4, 1e-9}) {
      CAPTURE(share);
      const Ray outer = random.past(surface, 1 + share);
      const RayHit miss = find_ray_hit(shape, {}, outer.origin, outer.direction, kInfinity);
      CHECK_FALSE(miss.hit);
      CHECK(miss.status == Status::Converged);
      const Ray inner = random.past(surface, 1 - share);
      const RayHit hit = find_ray_hit(shape, {}, inner.origin, inner.direction, kInfinity);
      REQUIRE(hit.hit);
      CHECK(hit.status == Status::Converged);
      check_hit(surface, inner, hit, find_crossings(surface, inner).entry, 1e-7);
    }
  });
}

TEST_CASE("grazing rays hit or miss rightly at a coarse tolerance, too") {
  const Settings coarse{.tolerance = 1e-3};
  for_bodies(220, kRaysPerClass / 10, [&](RandomRays& random, const Superellipsoid& surface, const Shape& /*shape*/) {
    const CallbackShape bare = without_hessian(make_shape(surface));
    for (const double share : {1e-4, 1e-6, 1e-9}) {
      CAPTURE(share);
      const Ray outer = random.past(surface, 1 + share), inner = random.past(surface, 1 - share);
      const double entry = find_crossings(surface, inner).entry;
      for (const Shape* shape : {static_cast<const Shape*>(&surface), static_cast<const Shape*>(&bare)}) {
        CHECK_FALSE(find_ray_hit(*shape, {}, outer.origin, outer.direction, kInfinity, coarse).hit);
        const RayHit hit = find_ray_hit(*shape, {}, inner.origin, inner.direction, kInfinity, coarse);
        REQUIRE(hit.hit);
        CHECK(hit.boundary_error <= 1e-3 * surface.half_axes().minCoeff());
        CHECK(std::abs(hit.distance - entry) <= hit.distance_error + 1e-9);
      }
    }
  });
}

TEST_CASE("rays from inside hit the exit, also along the flattest direction, and rays wholly inside hit nothing") {
  for_bodies(60, kRaysPerClass / 4, [](RandomRays& random, const Superellipsoid& surface, const Shape& shape) {
    const Ray ray{random.point(surface, random.uniform(0, 0.99)), random.direction()};
    const RayHit hit = find_ray_hit(shape, {}, ray.origin, ray.direction, kInfinity);
    REQUIRE(hit.hit);
    CHECK(hit.from_inside);
    CHECK(hit.status == Status::Converged);
    check_hit(surface, ray, hit, find_crossings(surface, ray).exit, 1e-8);
    const double margin = 1e-4 * hit.distance;
    CHECK_FALSE(find_ray_hit(shape, {}, ray.origin, ray.direction, hit.distance - margin).hit);
    CHECK(find_ray_hit(shape, {}, ray.origin, ray.direction, hit.distance + margin).hit);
  });
}

TEST_CASE("rays hit exactly if they are long enough and point to the body") {
  for_bodies(80, kRaysPerClass / 4, [](RandomRays& random, const Superellipsoid& surface, const Shape& shape) {
    const Ray ray = random.past(surface, random.uniform(0, 0.9));
    const Crossings crossings = find_crossings(surface, ray);
    CHECK_FALSE(find_ray_hit(shape, {}, ray.origin, ray.direction, 0.9999 * crossings.entry).hit);
    CHECK(find_ray_hit(shape, {}, ray.origin, ray.direction, 1.0001 * crossings.entry).hit);
    CHECK_FALSE(find_ray_hit(shape, {}, ray.origin, -ray.direction, kInfinity).hit);
    CHECK_FALSE(find_ray_hit(shape, {}, ray.at(1.0001 * crossings.exit), ray.direction, kInfinity).hit);
    CHECK_FALSE(find_ray_hit(shape, {}, ray.origin, ray.direction, 0).hit);
  });
}

TEST_CASE("rays at boxes agree with their slabs, and rays at capsules and cylinders with their distance") {
  RandomRays random(120);
  int hits = 0;
  for (int k = 0; k < 2000; ++k) {
    CAPTURE(k);
    const Vector3 half{random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2)};
    const Vector3 v = k % 5 == 0 ? Vector3(Vector3::Unit(k % 3)) : random.direction();
    const Vector3 o = random.uniform(0, 1.2) * half.cwiseProduct(random.direction()) - 10 * v;
    double entry = -kInfinity, exit = kInfinity;
    int face = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (v[axis] == 0) {
        if (std::abs(o[axis]) > half[axis]) exit = -kInfinity;
        continue;
      }
      const double near = (std::copysign(half[axis], -v[axis]) - o[axis]) / v[axis];
      exit = std::min(exit, (std::copysign(half[axis], v[axis]) - o[axis]) / v[axis]);
      if (near > entry) face = axis;
      entry = std::max(entry, near);
    }
    const RayHit hit = find_ray_hit(Box(half), {}, o, v, kInfinity);
    if (std::abs(exit - entry) < 1e-9) continue;
    REQUIRE(hit.hit == (exit > entry));
    if (!hit.hit) continue;
    ++hits;
    CHECK(hit.status == Status::Converged);
    CHECK(std::abs(hit.distance - entry) < 1e-9 * half.minCoeff() + 1e-13);
    if (exit - entry < 1e-3) continue;  // on an edge either normal is right
    CHECK(std::abs(hit.normal[face]) > 1 - 1e-9);
  }
  CHECK(hits > 1000);

  const Capsule capsule(0.3, 1);
  const Cylinder cylinder(0.7, 0.5);
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    const Vector3 v = random.direction();
    const Vector3 o = random.uniform(0, 0.25) * random.direction() - 10 * v;
    const RayHit on_capsule = find_ray_hit(capsule, {}, o, v, kInfinity);
    REQUIRE(on_capsule.hit);
    const double z = std::clamp(on_capsule.point.z(), -1.0, 1.0);
    CHECK(std::abs((on_capsule.point - Vector3(0, 0, z)).norm() - 0.3) < 1e-9);
    const RayHit on_cylinder = find_ray_hit(cylinder, {}, o, v, kInfinity);
    REQUIRE(on_cylinder.hit);
    const double r = on_cylinder.point.head<2>().norm();
    CHECK(std::abs(std::max(r / 0.7, std::abs(on_cylinder.point.z()) / 0.5) - 1) < 1e-9);
  }
}

TEST_CASE("rays at rounded bodies hit at the radius from the core") {
  unsigned seed = 140;
  for (const SuperellipsoidClass& kind : kSuperellipsoidClasses) {
    RandomRays random(++seed);
    for (int k = 0; k < 100; ++k) {
      const std::string name = std::string(kind.name) + " " + std::to_string(k);
      CAPTURE(name);
      const Superellipsoid core = random.shape(kind);
      const double unit = core.half_axes().minCoeff();
      const double radius = random.uniform(0.1, 1) * unit;
      const Rounded shape(std::make_shared<Superellipsoid>(core), radius);
      const Ray ray = random.past(core, random.uniform(0, 1));
      const RayHit hit = find_ray_hit(shape, {}, ray.origin, ray.direction, kInfinity);
      REQUIRE(hit.hit);
      const Proximity to_core = find_proximity(core, {}, Sphere(0), {hit.point, Matrix3::Identity()}, {.tolerance = 1e-12});
      CHECK(std::abs(to_core.gap - radius) <= 1.1e-9 * (unit + radius));
      CHECK((to_core.normal - hit.normal).norm() < 1e-5);
    }
  }
}
