// Tests that sweeping by a sphere adds `radius` to every support distance and every radius of curvature.
#include "supernormal/shapes/rounded.hpp"

#include <doctest/doctest.h>

#include <memory>

#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

TEST_CASE("rounding adds to the distance, the point and the radii of curvature") {
  for (const Superellipsoid& shape : superellipsoids(1.3, 50)) {
    const double radius = 0.25;
    const Rounded rounded(std::make_shared<Superellipsoid>(shape), radius);
    for (const Vector3& n : random_normals(10, 31)) {
      const Jet core = shape.jet(n), jet = rounded.jet(n);
      CHECK(jet.h == core.h + radius);
      CHECK((jet.r - core.r - radius * n).norm() <= 1e-15 * jet.r.norm());
      CHECK((jet.H * n).norm() <= 1e-14 * jet.H.norm());
      for (const Vector3& t : tangents(n)) {
        CHECK(std::abs(t.dot(jet.H * t) - t.dot(core.H * t) - radius) <= 1e-15 * (core.H.norm() + radius));
      }
    }
    CHECK(rounded.half_extents() == shape.half_extents() + Vector3::Constant(radius));
    CHECK(rounded.traits().has_flat_faces == shape.traits().has_flat_faces);
  }
}

TEST_CASE("a rounded sphere is a larger sphere, a rounded point a sphere") {
  const Sphere sphere(2.5);
  for (const double core_radius : {2.0, 0.0}) {
    const Rounded rounded(std::make_shared<Sphere>(core_radius), 2.5 - core_radius);
    for (const Vector3& n : random_normals(10, 32)) {
      const Jet a = rounded.jet(n), b = sphere.jet(n);
      CHECK(a.h == b.h);
      CHECK((a.r - b.r).norm() <= 1e-15);
      CHECK((a.H - b.H).norm() <= 2e-15);
    }
  }
}

TEST_CASE("rounding by 0 changes nothing; roundings add up") {
  const auto core = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 4.0, 1.5);
  const auto once = std::make_shared<Rounded>(core, 0.5);
  const Rounded none(core, 0), twice(once, 0.25), together(core, 0.75);
  for (const Vector3& n : random_normals(10, 33)) {
    const Jet unchanged = none.jet(n), original = core->jet(n);
    CHECK(unchanged.h == original.h);
    CHECK(unchanged.r == original.r);
    CHECK(unchanged.H == original.H);
    CHECK(twice.support(n) == relative(together.support(n)).epsilon(1e-15));
    CHECK((twice.point(n) - together.point(n)).norm() <= 2e-15);
  }
}

TEST_CASE("rounding a shape without a Hessian leaves it without") {
  const Ellipsoid ellipsoid(Vector3(3, 2, 1));
  const auto core = std::make_shared<CallbackShape>([&](const Vector3& n) { return ellipsoid.support(n); },
                                                    [&](const Vector3& n) { return ellipsoid.point(n); });
  const Rounded rounded(core, 0.5);
  CHECK_FALSE(rounded.traits().has_hessian);
  CHECK(Rounded(std::make_shared<Ellipsoid>(ellipsoid), 0.5).traits().has_hessian);
  const Vector3 n = Vector3(1, 2, 3).normalized();
  Jet jet;
  rounded.evaluate(n, Order::Hessian, jet);
  CHECK(jet.h == ellipsoid.support(n) + 0.5);
  CHECK(jet.H == Matrix3::Zero());
}
