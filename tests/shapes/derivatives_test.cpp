// Tests that r is the gradient of h, and H the gradient of r.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "supernormal/shapes/ellipsoid.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// The largest angle by which n may rotate before it crosses a coordinate plane, which limits the smoothness of h.
double room(const Vector3& n) { return 0.3 * std::asin(n.cwiseAbs().minCoeff()); }

/// The result of comparisons with finite differences.
struct Comparison {
  int checked = 0, undecided = 0;
};

/// Compares `claimed` with the derivative of f, as sharply as that is known. If the estimated error is above `resolution`, the
/// comparison decides nothing.
void compare(Comparison& comparison, const Derivative& numeric, const Vector3& claimed, double resolution,
             const std::string& what) {
  if (numeric.error > resolution) {
    ++comparison.undecided;
    return;
  }
  ++comparison.checked;
  const double difference = (numeric.value - claimed).norm();
  // Ridders' estimate is not a bound: it is seldom wrong by a factor of ten. The resolution itself is the least to expect.
  if (!(difference <= 10 * numeric.error + 0.1 * resolution))
    FAIL_CHECK(what, " differs by ", difference, " estimated error ", numeric.error);
}

void check_derivatives(const Shape& shape, const Vector3& n, const std::string& name, Comparison& gradient, Comparison& hessian) {
  const Jet jet = shape.jet(n);
  for (const Vector3& t : tangents(n)) {
    const auto turned = [&](double angle) -> Vector3 { return std::cos(angle) * n + std::sin(angle) * t; };
    const double first_step = room(n);
    const auto h = [&](double angle) { return Vector3(shape.support(turned(angle)), 0, 0); };
    const auto r = [&](double angle) { return shape.point(turned(angle)); };
    compare(gradient, derivative(h, first_step), Vector3(t.dot(jet.r), 0, 0), 1e-8 * jet.r.norm(),
            "r of " + name + " n " + text(n));
    const Vector3 bend = jet.H * t;
    compare(hessian, derivative(r, first_step), bend, 1e-7 * (bend.norm() + jet.r.norm()), "H of " + name + " n " + text(n));
  }
}

}  // namespace

TEST_CASE("superellipsoid: r is the gradient of h and H the gradient of r") {
  Comparison gradient, hessian;
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    for (const Vector3& n : random_normals(20, 11)) {
      if (n.cwiseAbs().minCoeff() < 0.03) continue;  // too narrow for a difference
      check_derivatives(shape, n, text(shape), gradient, hessian);
    }
  }
  CHECK(gradient.checked > 50 * gradient.undecided);
  CHECK(hessian.checked > 50 * hessian.undecided);
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

TEST_CASE("ellipsoid: r is the gradient of h and H the gradient of r") {
  Comparison gradient, hessian;
  for (const Vector3& half_axes : {Vector3(3, 2, 1), Vector3(1, 1, 1), Vector3(0.1, 10, 1)}) {
    for (const Vector3& n : random_normals(40, 12)) check_derivatives(Ellipsoid(half_axes), n, text(half_axes), gradient, hessian);
  }
  CHECK(gradient.undecided + hessian.undecided == 0);
}

TEST_CASE("the Hessian is symmetric, has the normal in its kernel and no negative radius") {
  const std::vector<Vector3> normals = all_normals(100, 13);
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    for (const Vector3& n : normals) {
      const Matrix3 hessian = shape.jet(n).H;
      const double largest = hessian.cwiseAbs().maxCoeff();
      if (largest < 1e-290) continue;  // a vertex, to within numbers too small to have full precision
      const Matrix3 H = hessian / largest;
      const bool symmetric = H == H.transpose();
      const bool kernel = (H * n).norm() <= 4e-15;
      // H is positive along any direction: this tests the diagonal entries and 2x2 minors.
      const double minor_xy = H(0, 0) * H(1, 1) - H(0, 1) * H(0, 1);
      const double minor_yz = H(1, 1) * H(2, 2) - H(1, 2) * H(1, 2);
      const double minor_zx = H(2, 2) * H(0, 0) - H(0, 2) * H(0, 2);
      const bool positive = H.diagonal().minCoeff() >= 0 && std::min({minor_xy, minor_yz, minor_zx}) >= -4e-15;
      if (!(symmetric && kernel && positive)) {
        FAIL_CHECK(text(shape), " n ", text(n), " symmetric ", symmetric, " |H n| ", (H * n).norm(), " minors ", minor_xy, " ",
                   minor_yz, " ", minor_zx);
      }
    }
  }
}
