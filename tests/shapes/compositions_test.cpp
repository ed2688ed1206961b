// Tests of shapes made of others: rounded, linear images, Minkowski sums.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

Matrix3 diagonal(double x, double y, double z) { return Vector3(x, y, z).asDiagonal(); }

Matrix3 some_shear() {
  Matrix3 matrix;
  matrix << 1.5, 0.4, -0.3, 0.2, 0.8, 0.5, -0.1, 0.3, 2;
  return matrix;
}

void check_same(const Shape& image, const Shape& expected, const std::vector<Vector3>& normals, double tolerance) {
  const double size = expected.half_extents().norm();
  for (const Vector3& n : normals) {
    const Jet a = image.jet(n), b = expected.jet(n);
    const double h_miss = std::abs(a.h - b.h) / b.h, r_miss = (a.r - b.r).norm() / size;
    const double hessian_miss = (a.H - b.H).cwiseAbs().maxCoeff() / b.H.cwiseAbs().maxCoeff();
    if (!(h_miss <= tolerance && r_miss <= tolerance && hessian_miss <= 20 * tolerance)) {
      FAIL_CHECK("n ", text(n), " h ", h_miss, " r ", r_miss, " H ", hessian_miss);
    }
  }
}

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

TEST_CASE("rounding adds to the distance, the point and the radii of curvature") {
  for (const Superellipsoid& shape : superellipsoids(1.3, 50)) {
    const double radius = shape.delta() > 2 ? 0.25 : 0;
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

TEST_CASE("linear image: the image of a sphere is the ellipsoid, to rounding") {
  const Ellipsoid ellipsoid(Vector3(3, 2, 1));
  const LinearImage image(std::make_shared<Sphere>(1), diagonal(3, 2, 1));
  check_same(image, ellipsoid, random_normals(200, 51), 2e-15);
  CHECK(image.half_extents() == Vector3(3, 2, 1));
  const MassProperties a = image.mass_properties(), b = ellipsoid.mass_properties();
  CHECK(a.volume == relative(b.volume).epsilon(1e-15));
  CHECK((a.second_moment - b.second_moment).norm() <= 1e-14 * b.second_moment.norm());
  CHECK(a.relative_error == 0);
  CHECK(image.min_curvature_radius_estimate() == relative(1.0 / 3).epsilon(1e-15));
}

TEST_CASE("linear image: superellipsoids scale with their half-axes") {
  for (const double exponent : {1.05, 1.5, 4.0, 50.0}) {
    const auto shape = std::make_shared<Superellipsoid>(Vector3(1, 1, 1), exponent, 3);
    const LinearImage image(shape, diagonal(3, 2, 0.5));
    const Superellipsoid expected(Vector3(3, 2, 0.5), exponent, 3);
    // The normal is divided by a length and multiplied again: this acts as rounding of the normal, which flat bodies amplify.
    std::vector<Vector3> normals = random_normals(100, 52);
    std::erase_if(normals, [](const Vector3& n) { return n.cwiseAbs().minCoeff() < 0.05; });
    check_same(image, expected, normals, 2e-14);
    CHECK(image.traits().has_flat_faces == expected.traits().has_flat_faces);
    for (const Vector3& n : normals) {
      const Vector3 dn = 0.01 * tangents(n)[0];
      const Vector3 advanced = image.advance_normal(n, image.jet(n), dn).normalized();
      CHECK((advanced - expected.advance_normal(n, expected.jet(n), dn).normalized()).norm() <= 1e-10);
    }
  }
}

TEST_CASE("linear image: turning and shearing back and forth changes nothing") {
  const auto shape = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 3, 1.6);
  const auto image = std::make_shared<LinearImage>(shape, some_shear());
  check_same(LinearImage(image, some_shear().inverse()), *shape, random_normals(100, 53), 1e-13);
  // A mirror image of a shape with three planes of symmetry is the shape itself.
  check_same(LinearImage(shape, diagonal(-1, 1, 1)), *shape, random_normals(100, 54), 1e-15);
}

TEST_CASE("linear image: H is the derivative of r, symmetric, with the normal in its kernel") {
  const LinearImage image(std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 3, 1.6), some_shear());
  for (const Vector3& n : random_normals(50, 55)) {
    const Jet jet = image.jet(n);
    CHECK(jet.H == jet.H.transpose());
    CHECK((jet.H * n).norm() <= 1e-14 * jet.H.norm());
    for (const Vector3& t : tangents(n)) {
      const auto r = [&](double angle) { return image.point(std::cos(angle) * n + std::sin(angle) * t); };
      const Derivative bend = derivative(r, 1e-3);
      CHECK((bend.value - jet.H * t).norm() <= 10 * bend.error + 1e-8 * jet.H.norm());
    }
  }
}

TEST_CASE("linear image: of a box a parallelepiped, with its vertices, faces, mass and gaps") {
  const Matrix3 matrix = some_shear();
  const auto box = std::make_shared<Box>(Vector3(1, 2, 0.5));
  const LinearImage image(box, matrix);
  std::vector<Vector3> points;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-2.0, 2.0}) {
      for (const double z : {-0.5, 0.5}) points.emplace_back(matrix * Vector3(x, y, z));
    }
  }
  const Polytope polytope(points);
  CHECK(image.traits().has_nonsmooth_points);
  CHECK((image.half_extents() - polytope.half_extents()).norm() <= 1e-15 * 3);
  const MassProperties a = image.mass_properties(), b = polytope.mass_properties();
  CHECK(a.volume == relative(b.volume).epsilon(1e-14));
  CHECK((a.second_moment - b.second_moment).norm() <= 1e-14 * b.second_moment.norm());
  const Ellipsoid ellipsoid(Vector3(1, 0.7, 0.4));
  const Pose here{Vector3::Zero(), Matrix3::Identity()};
  for (const Vector3& n : random_normals(40, 56)) {
    CHECK(image.support(n) == relative(polytope.support(n)).epsilon(1e-15));
    ActiveVertices vertices;
    image.add_active_vertices(n, Vector3::Zero(), vertices);
    CHECK(vertices.size() == 8);
    CHECK_FALSE(vertices.is_partial());
    const Pose there{4 * n, Matrix3::Identity()};
    CHECK(find_proximity(ellipsoid, here, image, there, Settings{}).gap ==
          relative(find_proximity(ellipsoid, here, polytope, there, Settings{}).gap).epsilon(1e-9));
  }
}

TEST_CASE("linear image: of a cylinder an elliptic one, caps found on the way across") {
  const LinearImage image(std::make_shared<Cylinder>(1, 2), diagonal(3, 1, 0.5));
  Vector3 face;
  CHECK(image.crosses_curved_face(Vector3(0.1, 0, 1), Vector3(-0.1, 0, 1), face));
  CHECK(face == Vector3(0, 0, 1));
  CHECK_FALSE(image.crosses_curved_face(Vector3(0.1, 0, 1), Vector3(0.2, 0, 1), face));
  for (const Vector3& n : random_normals(20, 57)) {
    CHECK(image.support(n) == relative(Vector3(3 * n.x(), n.y(), 0).norm() + std::abs(n.z())).epsilon(1e-15));
  }
}

TEST_CASE("linear image: what cannot be inverted is refused") {
  const auto sphere = std::make_shared<Sphere>(1);
  CHECK_THROWS_WITH_AS(LinearImage(nullptr, Matrix3::Identity()), "shape is null; a shape is needed", std::invalid_argument);
  CHECK_THROWS_WITH_AS(LinearImage(sphere, Matrix3::Zero()), "largest singular value of matrix = 0 is outside [1e-30, 1e+30]",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(LinearImage(sphere, diagonal(1, 1, 0)), "smallest singular value of matrix = 0 is outside [1e-12, 1]",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(LinearImage(sphere, Matrix3::Constant(std::numeric_limits<double>::quiet_NaN())),
                       "matrix has an entry that is not finite", std::invalid_argument);
  CHECK_NOTHROW(LinearImage(sphere, diagonal(1e-6, 1, -1e5)));
}

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

TEST_CASE("Minkowski sum: the mass of two balls, and of two ellipsoids of one shape") {
  const MinkowskiSum balls(std::make_shared<Sphere>(1), std::make_shared<Sphere>(0.25));
  const MinkowskiSum ellipsoids(std::make_shared<Ellipsoid>(Vector3(3, 2, 1)), std::make_shared<Ellipsoid>(Vector3(6, 4, 2)));
  CHECK(balls.mass_properties().volume == relative(Sphere(1.25).mass_properties().volume).epsilon(1e-12));
  CHECK(ellipsoids.mass_properties().volume == relative(27 * Ellipsoid(Vector3(3, 2, 1)).mass_properties().volume).epsilon(1e-11));
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
