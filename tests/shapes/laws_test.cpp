// What holds for every shape: r lies in the plane of h and is its gradient, H is the gradient of r, and nothing raises an
// exception.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "shapes/superovoid_samples.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

struct Sample {
  std::string name;
  std::shared_ptr<const Shape> shape;
  double exponent;  // the largest
  bool is_tapered = false;
  bool is_at_limit = false;  // tapers beyond which it is not convex, where radii of curvature jump

  double rounding() const { return is_tapered ? 8e-15 : 4e-15; }
};

/// Superellipsoids of all exponents, ellipsoids, superovoids and rounded bodies.
const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = [] {
    std::vector<Sample> list;
    for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
      list.push_back({text(shape), std::make_shared<Superellipsoid>(shape), std::max(shape.delta(), shape.epsilon())});
    }
    for (const Vector3& half_axes : {Vector3(3, 2, 1), Vector3(1, 1, 1), Vector3(0.1, 10, 1)}) {
      list.push_back({"ellipsoid " + text(half_axes), std::make_shared<Ellipsoid>(half_axes), 2});
    }
    for (const double exponent : {1.3, 4.0, 50.0}) {
      const auto core = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), exponent, 4);
      list.push_back({"rounded " + text(*core), std::make_shared<Rounded>(core, 0.3), exponent});
    }
    for (const Tapers& tapers : kTapers) {
      for (const Superovoid& shape : superovoids(1.01, 1000, {tapers})) {
        const double exponent = std::max(shape.delta(), shape.epsilon());
        list.push_back({text(shape), std::make_shared<Superovoid>(shape), exponent, true, tapers.x == 1});
      }
    }
    return list;
  }();
  return all;
}

/// Counts comparisons with finite differences.
struct Comparison {
  int checked = 0, undecided = 0;

  /// Compares `claimed` with the derivative of f, as sharply as that is known. If the estimated error is above `resolution`, the
  /// comparison decides nothing.
  void add(const Derivative& numeric, const Vector3& claimed, double resolution, const std::string& what) {
    if (numeric.error > resolution) {
      ++undecided;
      return;
    }
    ++checked;
    const double difference = (numeric.value - claimed).norm();
    // Ridders' estimate is not a bound: it is seldom wrong by a factor of ten. The resolution itself is the least to expect.
    if (!(difference <= 10 * numeric.error + 0.1 * resolution))
      FAIL_CHECK(what, " differs by ", difference, " estimated error ", numeric.error);
  }
};

/// All orders at n, and a step from there, under floating-point traps.
void check_quiet(const Shape& shape, const std::string& name) {
  const Traps traps(name.c_str());
  for (const Vector3& n : all_normals(50, 51)) {
    Jet jet;
    for (const Order order : {Order::Value, Order::Point, Order::Hessian}) shape.evaluate(n, order, jet);
    const Vector3 advanced = shape.advance_normal(n, jet, 1e-3 * tangents(n)[0]);
    const bool finite = std::isfinite(jet.h) && jet.r.allFinite() && jet.H.allFinite() && advanced.allFinite();
    if (!(finite && !advanced.isZero(0))) FAIL_CHECK(name, " n ", text(n), " advanced ", text(advanced));
  }
}

}  // namespace

TEST_CASE("shapes: the boundary point lies in its supporting plane, and an order delivers the same as the orders above it") {
  const std::vector<Vector3> normals = all_normals(300, 1);
  for (const Sample& sample : samples()) {
    const Shape& shape = *sample.shape;
    const Vector3 half = shape.half_extents();
    for (const Vector3& n : normals) {
      const Jet jet = shape.jet(n);
      const double size = sample.is_tapered ? half.sum() : n.cwiseAbs().dot(half);  // that of the summands
      const bool is_in_plane = std::abs(n.dot(jet.r) - jet.h) <= sample.rounding() * size;
      const bool is_in_octant = sample.is_tapered || (jet.r.array() * n.array().sign() >= 0).all();
      const bool is_inside = sample.is_tapered || (jet.r.cwiseAbs().array() <= half.array() * (1 + 1e-15)).all();
      if (!(is_in_plane && is_in_octant && is_inside && shape.support(n) == jet.h && shape.point(n) == jet.r)) {
        FAIL_CHECK(sample.name, " n ", text(n), " n.r ", n.dot(jet.r), " h ", jet.h);
      }
    }
  }
}

TEST_CASE("shapes: no point of the boundary lies outside a supporting plane") {
  const std::vector<Vector3> normals = all_normals(40, 4), planes = random_normals(20, 5);
  for (const Sample& sample : samples()) {
    std::vector<Vector3> points;
    points.reserve(normals.size());
    for (const Vector3& n : normals) points.push_back(sample.shape->point(n));
    for (const Vector3& n : planes) {
      double highest = -1e300;
      for (const Vector3& point : points) highest = std::max(highest, n.dot(point));
      const double beyond = highest - sample.shape->support(n);
      if (!(beyond <= sample.rounding() * sample.shape->half_extents().sum())) FAIL_CHECK(sample.name, " n ", text(n));
    }
  }
}

TEST_CASE("shapes: r is the gradient of h and H the gradient of r") {
  std::array<Comparison, 2> gradient, hessian;  // of straight and of tapered ones
  for (const Sample& sample : samples()) {
    if (sample.is_at_limit) continue;
    for (const Vector3& n : random_normals(sample.is_tapered ? 8 : 20, 11)) {
      const double room = 0.2 * std::asin(n.cwiseAbs().minCoeff());  // before it crosses a coordinate plane, where h bends
      if (room < 0.006) continue;                                    // too narrow for a difference
      const Jet jet = sample.shape->jet(n);
      for (const Vector3& t : tangents(n)) {
        const auto turned = [&](double angle) -> Vector3 { return std::cos(angle) * n + std::sin(angle) * t; };
        const auto h = [&](double angle) { return Vector3(sample.shape->support(turned(angle)), 0, 0); };
        const auto r = [&](double angle) { return sample.shape->point(turned(angle)); };
        const std::string where = sample.name + " n " + text(n);
        const Vector3 bend = jet.H * t;
        gradient[sample.is_tapered ? 1 : 0].add(derivative(h, room), Vector3(t.dot(jet.r), 0, 0), 1e-8 * jet.r.norm(),
                                                "r of " + where);
        hessian[sample.is_tapered ? 1 : 0].add(derivative(r, room), bend, 1e-7 * (bend.norm() + jet.r.norm()), "H of " + where);
      }
    }
  }
  for (const Comparison& comparison : {gradient[0], hessian[0]}) CHECK(comparison.checked > 50 * comparison.undecided);
  for (const Comparison& comparison : {gradient[1], hessian[1]}) CHECK(comparison.checked > 10 * comparison.undecided);
  CHECK(hessian[1].checked > draws(3000));
}

TEST_CASE("shapes: the Hessian is symmetric, has the normal in its kernel and no negative radius") {
  const std::vector<Vector3> normals = all_normals(100, 13);
  for (const Sample& sample : samples()) {
    for (const Vector3& n : normals) {
      const Matrix3 hessian = sample.shape->jet(n).H;
      const double largest = hessian.cwiseAbs().maxCoeff();
      if (largest < 1e-290) continue;  // a vertex, to within numbers too small to have full precision
      const Matrix3 H = hessian / largest;
      // H is positive along any direction: this tests the diagonal entries and 2x2 minors.
      const double minor_xy = H(0, 0) * H(1, 1) - H(0, 1) * H(0, 1);
      const double minor_yz = H(1, 1) * H(2, 2) - H(1, 2) * H(1, 2);
      const double minor_zx = H(2, 2) * H(0, 0) - H(0, 2) * H(0, 2);
      const bool positive = H.diagonal().minCoeff() >= 0 && std::min({minor_xy, minor_yz, minor_zx}) >= -sample.rounding();
      const double kernel = (H * n).norm(), asymmetry = (H - H.transpose()).cwiseAbs().maxCoeff();
      const bool is_ellipsoid = sample.exponent == 2 && !sample.is_tapered;  // its products are rounded
      if (!(asymmetry <= (is_ellipsoid ? 1e-15 : 0) && kernel <= (sample.is_tapered ? 1e-14 : 4e-15) && positive)) {
        FAIL_CHECK(sample.name, " n ", text(n), " |H n| ", kernel, " minors ", minor_xy, " ", minor_yz, " ", minor_zx);
      }
    }
  }
}

TEST_CASE("shapes: the advanced normal of a small step is n + dn to first order, and without a step n") {
  for (const Sample& sample : samples()) {
    if (sample.is_at_limit) continue;
    const double rounding = sample.is_tapered ? 1e-14 * (sample.exponent + 1) : 2e-12;  // of a power with the exponent
    for (const Vector3& n : random_normals(12, 21)) {
      if (n.cwiseAbs().minCoeff() < 0.1) continue;  // a step of 1e-3 is a small one
      const Jet jet = sample.shape->jet(n);
      const auto deviation = [&](const Vector3& dn) {
        return (sample.shape->advance_normal(n, jet, dn).normalized() - (n + dn).normalized()).norm();
      };
      if (!(deviation(Vector3::Zero()) <= rounding)) FAIL_CHECK(sample.name, " n ", text(n), " does not come back");
      for (const Vector3& t : tangents(n)) {
        const double coarse = deviation(1e-4 * t), fine = deviation(1e-5 * t);
        // A second-order deviation shrinks a hundredfold.
        if (!(fine <= coarse / 50 + rounding)) FAIL_CHECK(sample.name, " n ", text(n), " deviations ", coarse, " ", fine);
      }
    }
  }
}

TEST_CASE("shapes of every exponent, the smallest, the largest and the thinnest are finite everywhere and raise nothing") {
  for (const Sample& sample : samples()) check_quiet(*sample.shape, sample.name);
  for (const Vector3& half_axes :
       {Vector3(1e-30, 1e-30, 1e-30), Vector3(1e30, 1e30, 1e30), Vector3(1e30, 1, 1e-30), Vector3(1, 1e4, 1e-4)}) {
    for (const double exponent : {1.01, 1.5, 2.0, 5.0, 1000.0}) {
      const double taper = 0.7 * Superovoid::max_taper(exponent);
      check_quiet(Superellipsoid(half_axes, exponent, exponent), "superellipsoid " + text(half_axes));
      check_quiet(Superovoid(half_axes, exponent, exponent, taper, taper), "superovoid " + text(half_axes));
    }
    check_quiet(Ellipsoid(half_axes), "ellipsoid " + text(half_axes));
  }
  for (const double radius : {1e30, 0.0}) check_quiet(Sphere(radius), "sphere");
}

TEST_CASE("mass properties raise nothing") {
  const Traps traps("mass properties");
  for (const double exponent : {1.01, 1.5, 2.0, 5.0, 1000.0}) {
    for (const Vector3& half_axes : {Vector3(1e-30, 1e-30, 1e-30), Vector3(1e30, 1e30, 1e30), Vector3(3, 2, 1)}) {
      const auto shape = std::make_shared<Superellipsoid>(half_axes, exponent, exponent);
      const MassProperties plain = shape->mass_properties();
      const MassProperties swept = Rounded(shape, 0.1 * half_axes.x()).mass_properties();
      CHECK(std::isfinite(plain.volume + swept.volume));
      CHECK((plain.second_moment + swept.second_moment).allFinite());
      CHECK(plain.volume > 0);
      CHECK(swept.volume > plain.volume);
    }
  }
  Ellipsoid(Vector3(3, 2, 1)).Shape::mass_properties();
  Sphere(0).Shape::mass_properties();
}
