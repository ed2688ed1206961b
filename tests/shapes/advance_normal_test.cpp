// Tests of advance_normal(): the normal where the boundary point has moved by H dn.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// The angle between advance_normal() and n + dn, rad (for small angles).
double deviation(const Shape& shape, const Vector3& n, const Vector3& dn) {
  const Vector3 advanced = shape.advance_normal(n, shape.jet(n), dn).normalized();
  return (advanced - (n + dn).normalized()).norm();
}

/// Normals far enough from the coordinate planes that a step of 1e-3 is a small one.
std::vector<Vector3> smooth_normals(int count, unsigned seed) {
  std::vector<Vector3> normals = random_normals(count, seed);
  normals.erase(std::remove_if(normals.begin(), normals.end(), [](const Vector3& n) { return n.cwiseAbs().minCoeff() < 0.1; }),
                normals.end());
  return normals;
}

void check_second_order(const Shape& shape, const std::string& name) {
  for (const Vector3& n : smooth_normals(12, 21)) {
    for (const Vector3& t : tangents(n)) {
      const double coarse = deviation(shape, n, 1e-4 * t);
      const double fine = deviation(shape, n, 1e-5 * t);
      // A second-order deviation shrinks a hundredfold; 2e-12 is the rounding of a power with exponent 1000.
      if (!(fine <= coarse / 50 + 2e-12)) FAIL_CHECK(name, " n ", text(n), " deviations ", coarse, " ", fine);
    }
  }
}

}  // namespace

TEST_CASE("superellipsoid: advance_normal is n + dn to first order") {
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) check_second_order(shape, text(shape));
}

TEST_CASE("rounded superellipsoid: advance_normal is n + dn to first order") {
  for (const double exponent : {1.3, 4.0, 50.0}) {
    const auto core = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), exponent, 4.0);
    check_second_order(Rounded(core, 0.3), text(*core));
  }
}

TEST_CASE("advance_normal is n + dn exactly where there are no flat faces") {
  const Vector3 n = Vector3(1, 2, 3).normalized(), dn(0.3, -0.2, 0.1);
  const Ellipsoid ellipsoid(Vector3(3, 2, 1));
  const Superellipsoid sharp(Vector3(3, 2, 1), 1.3, 2);
  CHECK_FALSE(ellipsoid.traits().has_flat_faces);
  CHECK_FALSE(sharp.traits().has_flat_faces);
  CHECK(ellipsoid.advance_normal(n, ellipsoid.jet(n), dn) == n + dn);
  CHECK(sharp.advance_normal(n, sharp.jet(n), dn) == n + dn);
}

TEST_CASE("superellipsoid: without a step the boundary point gives its normal back, digit by digit near the planes too") {
  const std::vector<Vector3> normals = all_normals(100, 22);
  for (const Superellipsoid& shape : superellipsoids(2.4, 1000)) {
    const double largest_exponent = std::max(shape.delta(), shape.epsilon());
    for (const Vector3& n : normals) {
      const Vector3 back = shape.advance_normal(n, shape.jet(n), Vector3::Zero()).normalized();
      for (int axis = 0; axis < 3; ++axis) {
        // n_i is a power, of exponent up to `largest_exponent`, of a coordinate; that is right to rounding times the logarithm of
        // n_i, because the exponents are rounded too.
        const double size = std::abs(n[axis]);
        const double relative = largest_exponent * (2e-15 + (size > 0 ? -3e-16 * std::log(size) : 0));
        if (!(std::abs(back[axis] - n[axis]) <= relative * size + 1e-290))
          FAIL_CHECK(text(shape), " n ", text(n), " back ", text(back));
      }
    }
  }
}

TEST_CASE("flat superellipsoid: the advanced normal is the normal of the moved point") {
  const std::vector<Vector3> normals = all_normals(100, 23);
  const std::vector<Vector3> steps = random_normals(static_cast<int>(normals.size()), 24);
  int checked = 0;
  for (const Superellipsoid& shape : superellipsoids(2.4, 200)) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vector3& n = normals[i];
      const Jet jet = shape.jet(n);
      // The step moves the point by up to the size of the body: across planes of symmetry, along faces.
      Vector3 dn = steps[i] - n * n.dot(steps[i]);
      const double move = (jet.H * dn).cwiseQuotient(shape.half_axes()).norm();
      dn *= std::pow(10.0, -static_cast<double>(i % 7)) / std::max(1.0, move);
      const Vector3 advanced = shape.advance_normal(n, jet, dn);
      REQUIRE(advanced.allFinite());
      REQUIRE(advanced.norm() > 0);
      // The target is off the surface by second order; the surface point meant is on the ray from the centre to it.
      const Vector3 wanted = (jet.r + jet.H * dn).cwiseQuotient(shape.half_axes()).normalized();
      const Vector3 reached = shape.point(advanced.normalized()).cwiseQuotient(shape.half_axes()).normalized();
      // The normal of a coordinate below 0.05 is below 0.05^199, too near the smallest number to be exact. (0 is exact.)
      const auto is_representable = [](double x) { return x == 0 || std::abs(x) > 0.05; };
      if (!is_representable(wanted.x()) || !is_representable(wanted.y()) || !is_representable(wanted.z())) continue;
      ++checked;
      const double miss = (reached - wanted).norm();
      if (!(miss <= 1e-13)) FAIL_CHECK(text(shape), " n ", text(n), " dn ", text(dn), " miss ", miss);
    }
  }
  CHECK(checked > 10000);
}

TEST_CASE("flat cross-sections, sharp at the pole: a step across the plane of symmetry takes the point away") {
  const Superellipsoid superellipsoid({3, 2, 1}, 4.2, 1.7);
  const Superovoid superovoid({3, 2, 1}, 4.2, 1.7, 0.4, -0.3);
  for (const Shape* shape : {static_cast<const Shape*>(&superellipsoid), static_cast<const Shape*>(&superovoid)}) {
    const Vector3 n(0, -1e-17, -1);
    const Jet jet = shape->jet(n);
    CHECK(jet.H(0, 0) > 1e10);
    const Vector3 advanced = shape->advance_normal(n, jet, Vector3(0.01 / jet.H(0, 0), 0, 0));
    const Vector3 reached = shape->point(advanced.normalized());
    CHECK(reached.x() == doctest::Approx(0.01).epsilon(1e-3));
    CHECK(std::abs(reached.y()) <= 1e-15);
  }
}

TEST_CASE("a flat face with sharp sections: the point goes where it is to go, however far a normal near the axis rotates") {
  const Superellipsoid superellipsoid({1.03, 0.39, 1.14}, 1.06, 35);
  const Superovoid superovoid({1.03, 0.39, 1.14}, 1.06, 35, 0.01, 0.01);
  for (const Shape* shape : {static_cast<const Shape*>(&superellipsoid), static_cast<const Shape*>(&superovoid)}) {
    const auto miss = [&](const Vector3& n, const Vector3& way) {
      const Jet jet = shape->jet(n);
      const Vector3 target = jet.r + jet.H * way;
      return (shape->point(shape->advance_normal(n, jet, way).normalized()) - target).norm();
    };
    const auto along_x = [&](const Vector3& n, double way) { return way / shape->jet(n).H(0, 0); };
    // The step leads off a curved edge by 10 000 times its part across the axis.
    const Vector3 beside(1e-15, 0, -1);
    for (const double turn : {1e-12, 1e-11, 1e-5}) CHECK(miss(beside, {along_x(beside, 0.13), turn, 0}) <= 1e-3);
    // The step leads across the middle of the face.
    for (const double turn : {1e-12, 1e-11, 1e-5}) CHECK(miss(beside, {along_x(beside, -0.8), turn, 0}) <= 1e-3);
    // The step leads to another side of the section.
    const Vector3 oblique(4e-17, -1.6e-16, -1);
    const Jet jet = shape->jet(oblique);
    const Eigen::Vector2d way = jet.H.topLeftCorner<2, 2>().inverse() * Eigen::Vector2d(-0.3, -0.01);
    CHECK(miss(oblique, {way.x(), way.y(), 0}) <= 1e-2);
  }
}
