// Tests of superellipsoids: the boundary point is on the surface, and advance_normal() is where the point has moved by H dn.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/lanes/four_normals.hpp"
#include "shapes/lanes/lane_body_of.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// The left side of the implicit equation in extended precision, so that the test's own rounding does not count.
double implicit(const Superellipsoid& shape, const Vector3& point) {
  using Real = long double;
  const auto ratio = [&](int axis) {
    return std::abs(static_cast<Real>(point[axis])) / static_cast<Real>(shape.half_axes()[axis]);
  };
  const Real delta = shape.delta(), epsilon = shape.epsilon();
  const Real section = std::pow(ratio(0), delta) + std::pow(ratio(1), delta);
  return static_cast<double>(std::pow(section, epsilon / delta) + std::pow(ratio(2), epsilon));
}

using FourVectors = Eigen::Array<double, 4, 3>;

struct Evaluated {
  Eigen::Array4d h;
  FourVectors points;
  Evaluated(EvaluateFour* evaluate, const Superellipsoid& shape, const FourVectors& normals) {
    evaluate(*LaneBodies::of(shape), normals.data(), h.data(), points.data());
  }
};

}  // namespace

TEST_CASE("superellipsoid: the boundary point satisfies the implicit equation to 1e-12") {
  const std::vector<Vector3> normals = all_normals(300, 1);
  for (const Superellipsoid& shape : superellipsoids(1.02, 200)) {
    for (const Vector3& n : normals) {
      const double residual = std::abs(implicit(shape, shape.point(n)) - 1);
      if (!(residual <= 1e-12)) FAIL_CHECK(text(shape), " n ", text(n), " residual ", residual);
    }
  }
}

TEST_CASE("superellipsoid: everything scales with the half-axes, exactly for powers of two") {
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    const double scale = std::ldexp(1.0, -20);
    const Superellipsoid small(scale * shape.half_axes(), shape.delta(), shape.epsilon());
    for (const Vector3& n : random_normals(5, 4)) {
      const Jet jet = shape.jet(n), scaled = small.jet(n);
      CHECK(scaled.h == scale * jet.h);
      CHECK(scaled.r == scale * jet.r);
      CHECK(scaled.H == scale * jet.H);
    }
  }
}

TEST_CASE("superellipsoid with exponents 2 is an ellipsoid") {
  for (const Vector3& half_axes : {Vector3(3, 2, 1), Vector3(1, 1, 1), Vector3(0.01, 1, 0.3)}) {
    const Superellipsoid general(half_axes, 2, 2);
    const Ellipsoid special(half_axes);
    for (const Vector3& n : all_normals(300, 1)) {
      const Jet a = general.jet(n), b = special.jet(n);
      CHECK(std::abs(a.h - b.h) <= 8e-16 * b.h);  // two nested norms of four roundings each
      CHECK((a.r - b.r).cwiseQuotient(half_axes).cwiseAbs().maxCoeff() <= 1e-15);
      const double largest = half_axes.cwiseAbs2().maxCoeff() / b.h;  // size of the terms that make up H
      CHECK((a.H - b.H).cwiseAbs().maxCoeff() <= 2e-15 * largest);
    }
  }
}

TEST_CASE("superellipsoid: the fast paths for exponents of 2 join the general one smoothly") {
  // A change of an exponent by 1e-12 changes h by about 1e-12 of itself, and r and H by a few logarithms more.
  const double beside[] = {2 - 1e-12, 2 + 1e-12};
  const Vector3 half_axes(3, 2, 1);
  for (const double other : {1.3, 2.0, 6.0}) {
    for (const double two : beside) {
      const std::pair<Superellipsoid, Superellipsoid> pairs[] = {
          {Superellipsoid(half_axes, 2, other), Superellipsoid(half_axes, two, other)},
          {Superellipsoid(half_axes, other, 2), Superellipsoid(half_axes, other, two)}};
      for (const auto& [fast, general] : pairs) {
        for (const Vector3& n : random_normals(100, 5)) {
          const Jet a = fast.jet(n), b = general.jet(n);
          CHECK(std::abs(a.h - b.h) <= 5e-12 * b.h);
          CHECK((a.r - b.r).norm() <= 2e-11 * b.r.norm());
          CHECK((a.H - b.H).norm() <= 5e-11 * b.H.norm());
        }
      }
    }
  }
}

TEST_CASE("half extents are the half-axes, exactly, in closed form and by the support function") {
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    CHECK(shape.half_extents() == shape.half_axes());
    CHECK(shape.Shape::half_extents() == shape.half_axes());
  }
  CHECK(Ellipsoid(Vector3(3, 2, 1)).half_extents() == Vector3(3, 2, 1));
  CHECK(Ellipsoid(Vector3(3, 2, 1)).Shape::half_extents() == Vector3(3, 2, 1));
  CHECK(Sphere(2).half_extents() == Vector3(2, 2, 2));
}

TEST_CASE("sphere: support function, point and Hessian; a point if the radius is 0") {
  for (const Vector3& n : random_normals(20, 6)) {
    const Jet jet = Sphere(2).jet(n);
    CHECK(jet.h == 2);
    CHECK(jet.r == 2 * n);
    CHECK((jet.H * n).norm() <= 1e-15);
    CHECK(jet.H.trace() == relative(4).epsilon(1e-15));
    CHECK(Sphere(0).support(n) == 0);
    CHECK(Sphere(0).jet(n).H == Matrix3::Zero());
  }
}

TEST_CASE("superellipsoid: H is known near the coordinate planes, where it is a steep function of the normal") {
  // The angle from the plane has to be resolved in proportion: r is a power of it there.
  for (const double exponent : {1.3, 3.0, 20.0}) {
    const Superellipsoid shape(Vector3(3, 2, 1), exponent, exponent);
    for (const double angle : {1e-3, 1e-6, 1e-9}) {
      for (int axis = 0; axis < 3; ++axis) {
        Vector3 base = Vector3(0.6, 0.5, 0.4);
        base[axis] = 0;
        base.normalize();
        const auto turned = [&](double alpha) -> Vector3 { return std::cos(alpha) * base + std::sin(alpha) * Vector3::Unit(axis); };
        const Vector3 t = -std::sin(angle) * base + std::cos(angle) * Vector3::Unit(axis);
        // The difference is taken across the plane only: along it the point is as good as fixed, and differences of its
        // coordinates are rounding.
        const auto across = [&](double beta) { return Vector3(shape.point(turned(angle + beta))[axis], 0, 0); };
        const Derivative numeric = derivative(across, 0.3 * angle);
        const double claimed = (shape.jet(turned(angle)).H * t)[axis];
        CHECK(numeric.error <= 1e-8 * claimed);
        CHECK(std::abs(numeric.value.x() - claimed) <= 1e-8 * claimed);
      }
    }
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

TEST_CASE("four normals at once have the points of each alone to rounding, at any length, and the same digits in every width") {
  std::vector<Vector3> normals = all_normals(300, 1);
  // A subnormal component loses digits with the length.
  std::erase_if(normals, [](const Vector3& n) { return (n.array().abs() > 0 && n.array().abs() < 1e-300).any(); });
  for (const Superellipsoid& shape : superellipsoids(1.02, 200)) {
    const double size = shape.half_axes().norm();
    for (std::size_t first = 0; first + 4 <= normals.size(); first += 4) {
      FourVectors four;
      for (int k = 0; k < 4; ++k) four.row(k) = (k + 0.5) * normals[first + static_cast<std::size_t>(k)].transpose().array();
      const Evaluated together(four_at_once(), shape, four), narrow(evaluate_in_two_lanes, shape, four);
      CHECK((together.h == narrow.h).all());
      CHECK((together.points == narrow.points).all());
      for (int k = 0; k < 4; ++k) {
        const Jet alone = shape.jet(normals[first + static_cast<std::size_t>(k)]);
        CHECK(std::abs(together.h[k] / (k + 0.5) - alone.h) <= 1e-14 * size);
        CHECK((together.points.row(k).transpose().matrix() - alone.r).norm() <= 1e-11 * size);
      }
    }
  }
}
