// Tests of the sum of two shapes: support functions add; known sums.
#include "supernormal/shapes/minkowski_sum.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// Checks that every vertex is a point of the body, and that the highest is on its supporting plane.
void check_corners(const Shape& shape, const Vector3& n) {
  ActiveVertices vertices;
  shape.add_active_vertices(n, Vector3(0.3, -0.2, 0.1), vertices);
  REQUIRE(vertices.size() > 0);
  double highest = -1e300;
  for (int k = 0; k < vertices.size(); ++k) {
    highest = std::max(highest, n.dot(vertices[k]));
    for (const Vector3& m : random_normals(30, 41)) CHECK(m.dot(vertices[k]) <= shape.support(m) + 1e-14);
  }
  CHECK(highest == relative(shape.support(n)).epsilon(1e-14));
}

/// The gap of a body and a smooth one, by a query.
double gap(const Shape& shape, const Shape& other, const Vector3& at) {
  return find_proximity(other, Pose{Vector3::Zero(), Matrix3::Identity()}, shape, Pose{at, Matrix3::Identity()}, Settings{}).gap;
}

}  // namespace

TEST_CASE("Minkowski sum: support function, point and Hessian are sums") {
  const auto boxy = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 6, 4);
  const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(0.5, 1, 2));
  const MinkowskiSum sum(boxy, ellipsoid);
  for (const Vector3& n : random_normals(50, 42)) {
    const Jet a = boxy->jet(n), b = ellipsoid->jet(n), jet = sum.jet(n);
    CHECK(jet.h == a.h + b.h);
    CHECK(jet.r == a.r + b.r);
    CHECK(jet.H == a.H + b.H);
  }
  CHECK(sum.half_extents() == Vector3(3.5, 3, 3));
  CHECK(sum.traits().has_flat_faces);
  CHECK_FALSE(sum.traits().has_nonsmooth_points);
  CHECK(sum.traits().has_hessian);
}

TEST_CASE("Minkowski sum: of equal heights the first vertices are kept, in their order") {
  const auto first = std::make_shared<Box>(Vector3(3, 2, 1)), second = std::make_shared<Box>(Vector3(0.5, 1, 2));
  const Vector3 n = Vector3::UnitZ(), dn(0.3, -0.2, 0.1);
  ActiveVertices of_first, of_second, vertices;
  first->add_active_vertices(n, dn, of_first);
  second->add_active_vertices(n, dn, of_second);
  MinkowskiSum(first, second).add_active_vertices(n, dn, vertices);
  std::vector<Vector3> sums;
  for (int i = 0; i < of_first.size(); ++i) {
    for (int j = 0; j < of_second.size(); ++j) sums.emplace_back(of_first[i] + of_second[j]);
  }
  std::stable_sort(sums.begin(), sums.end(), [&](const Vector3& a, const Vector3& b) { return n.dot(a) > n.dot(b); });
  REQUIRE(vertices.size() == ActiveVertices::kCapacity);
  for (int k = 0; k < vertices.size(); ++k) CHECK(vertices[k] == sums[static_cast<std::size_t>(k)]);
}

TEST_CASE("Minkowski sum: with a sphere it is the rounded shape, with a point the shape moved") {
  const auto core = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 6, 1.5);
  const MinkowskiSum sum(core, std::make_shared<Sphere>(0.5));
  const Rounded rounded(core, 0.5);
  const Vector3 point(1, -2, 3);
  const MinkowskiSum moved(core, std::make_shared<Polytope>(std::span(&point, 1)));
  CHECK_FALSE(moved.traits().has_nonsmooth_points);
  for (const Vector3& n : random_normals(50, 43)) {
    const Jet a = sum.jet(n), b = rounded.jet(n);
    CHECK(a.h == b.h);
    CHECK((a.r - b.r).norm() <= 1e-15);
    CHECK((a.H - b.H).norm() <= 1e-15 * b.H.norm());
    CHECK((moved.point(n) - core->point(n) - point).norm() <= 1e-15);
    const Vector3 dn = 0.1 * tangents(n)[0];
    CHECK((sum.advance_normal(n, a, dn) - rounded.advance_normal(n, b, dn)).norm() <= 1e-9);
  }
}

TEST_CASE("Minkowski sum: two balls, two ellipsoids of one shape, a segment and a sphere") {
  const MinkowskiSum balls(std::make_shared<Sphere>(1), std::make_shared<Sphere>(0.25));
  const MinkowskiSum ellipsoids(std::make_shared<Ellipsoid>(Vector3(3, 2, 1)), std::make_shared<Ellipsoid>(Vector3(6, 4, 2)));
  const MinkowskiSum capsule(std::make_shared<Capsule>(0, 2), std::make_shared<Sphere>(0.5));
  CHECK(balls.mass_properties().volume == relative(Sphere(1.25).mass_properties().volume).epsilon(1e-12));
  CHECK(ellipsoids.mass_properties().volume == relative(27 * Ellipsoid(Vector3(3, 2, 1)).mass_properties().volume).epsilon(1e-11));
  for (const Vector3& n : random_normals(30, 44)) {
    CHECK(ellipsoids.support(n) == relative(Ellipsoid(Vector3(9, 6, 3)).support(n)).epsilon(1e-15));
    const Jet a = capsule.jet(n), b = Capsule(0.5, 2).jet(n);
    CHECK(a.h == relative(b.h).epsilon(1e-15));
    CHECK((a.r - b.r).norm() <= 1e-15);
    CHECK((a.H - b.H).norm() <= 1e-15);
  }
}

TEST_CASE("Minkowski sum: boxes add to a box, vertices are points of the body and reach the supporting plane") {
  const auto box = std::make_shared<Box>(Vector3(3, 2, 1));
  const auto small = std::make_shared<Box>(Vector3(0.5, 0.25, 1));
  const auto cylinder = std::make_shared<Cylinder>(0.5, 1);
  const auto smooth = std::make_shared<Ellipsoid>(Vector3(0.5, 1, 2));
  for (const Vector3& n : random_normals(20, 45)) {
    CHECK(MinkowskiSum(box, small).support(n) == relative(Box(Vector3(3.5, 2.25, 2)).support(n)).epsilon(1e-15));
    for (const auto& other :
         {std::shared_ptr<const Shape>(small), std::shared_ptr<const Shape>(cylinder), std::shared_ptr<const Shape>(smooth)}) {
      check_corners(MinkowskiSum(box, other), n);
      check_corners(MinkowskiSum(other, box), n);
    }
    check_corners(Rounded(box, 0.3), n);
    check_corners(Rounded(cylinder, 0.3), n);
  }
  for (const Vector3& n : {Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(0, 0.6, 0.8)}) {
    check_corners(MinkowskiSum(box, cylinder), n);
    check_corners(Rounded(cylinder, 0.3), n);
  }
  Vector3 face;
  CHECK(MinkowskiSum(smooth, cylinder).crosses_curved_face(Vector3(0.1, 0, 1), Vector3(-0.1, 0, 1), face));
  CHECK(face == Vector3(0, 0, 1));
  CHECK(Rounded(cylinder, 0.1).crosses_curved_face(Vector3(0.1, 0, -1), Vector3(-0.1, 0, -1), face));
  CHECK(face == Vector3(0, 0, -1));
}

TEST_CASE("Minkowski sum: the gap of a sum follows from its parts") {
  // dist(A + B, C) = dist(A, C - B): with a ball C and a body B that is its own mirror image, there are three ways to one number.
  const auto box = std::make_shared<Box>(Vector3(3, 2, 1));
  const auto ellipsoid = std::make_shared<Ellipsoid>(Vector3(0.5, 1, 0.7));
  const Sphere ball(0.4);
  for (const Vector3& direction : random_normals(40, 46)) {
    for (const double distance : {2.5, 4.5, 9.0}) {
      const Vector3 at = distance * direction;
      const double expected = gap(*box, MinkowskiSum(ellipsoid, std::make_shared<Sphere>(0.4)), at);
      CHECK(gap(MinkowskiSum(box, ellipsoid), ball, at) == relative(expected).epsilon(1e-9));
      CHECK(gap(Rounded(box, 0.4), *ellipsoid, at) == relative(expected).epsilon(1e-9));
    }
  }
}

TEST_CASE("Minkowski sum: a part without a Hessian leaves it without; a missing part is refused") {
  const auto sphere = std::make_shared<Sphere>(1);
  const auto callback = std::make_shared<CallbackShape>([&](const Vector3&) { return 1.0; }, [&](const Vector3& n) { return n; });
  const MinkowskiSum sum(sphere, callback);
  CHECK_FALSE(sum.traits().has_hessian);
  CHECK(sum.mass_properties().volume == relative(Sphere(2).mass_properties().volume).epsilon(1e-10));
  CHECK_THROWS_WITH_AS(MinkowskiSum(nullptr, sphere), "first is null; a shape is needed", std::invalid_argument);
  CHECK_THROWS_WITH_AS(MinkowskiSum(sphere, nullptr), "second is null; a shape is needed", std::invalid_argument);
}
