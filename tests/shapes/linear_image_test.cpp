// Tests of stretched, sheared, rotated and mirrored shapes against known shapes.
#include "supernormal/shapes/linear_image.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <stdexcept>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
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

}  // namespace

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
