// Tests of the boundary point: on the surface, on its supporting plane, for every exponent and normal.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
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

TEST_CASE("superellipsoid: the boundary point lies in its supporting plane, in the octant of its normal") {
  const std::vector<Vector3> normals = all_normals(300, 1);
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    for (const Vector3& n : normals) {
      const Jet jet = shape.jet(n);
      const double size = n.cwiseAbs().dot(shape.half_axes());  // the summands' size bounds their rounding
      if (!(std::abs(n.dot(jet.r) - jet.h) <= 4e-15 * size)) {
        FAIL_CHECK(text(shape), " n ", text(n), " n.r ", n.dot(jet.r), " h ", jet.h);
      }
      for (int axis = 0; axis < 3; ++axis) {
        const double along = jet.r[axis] * std::copysign(1.0, n[axis]);
        if (!(along >= 0 && along <= shape.half_axes()[axis] * (1 + 1e-15)))
          FAIL_CHECK(text(shape), " n ", text(n), " axis ", axis);
      }
    }
  }
}

TEST_CASE("superellipsoid: no point of the boundary lies outside a supporting plane") {
  const std::vector<Vector3> normals = random_normals(60, 2);
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    for (const Vector3& n : normals) {
      const double h = shape.support(n);
      for (const Vector3& other : normals) {
        if (!(n.dot(shape.point(other)) <= h + 4e-15 * shape.half_axes().sum()))
          FAIL_CHECK(text(shape), " n ", text(n), text(other));
      }
    }
  }
}

TEST_CASE("superellipsoid: an order delivers the same as the orders above it") {
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    for (const Vector3& n : random_normals(10, 3)) {
      const Jet jet = shape.jet(n);
      CHECK(shape.support(n) == jet.h);
      CHECK(shape.point(n) == jet.r);
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
