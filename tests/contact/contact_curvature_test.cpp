// Tests of the curvatures of contacts, and of Hertz's force for them.
#include "supernormal/contact/contact_curvature.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "proximity/lanes/lane_query.hpp"
#include "supernormal/contact/hertz.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/random_queries.hpp"
#include "support/relative.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// Overlaps of all classes, and some pairs apart.
class Overlaps : public RandomQueries {
 public:
  Overlaps() {
    for (const RandomKind& kind : random_kinds()) {
      RandomBodies& bodies = bodies_of(kind, 5);
      for (int k = 0; k < 40; ++k) {
        for (const double gap : {-0.1, -1e-2, -1e-4, 0.1}) add(bodies.draw(gap));
      }
    }
    for (std::size_t k = 0; k < pair_count(); ++k) ask(k, normal(k));
  }
};

ContactCurvature curvature_at(const ProximityQuery& query, const Vector3& n) {
  return find_contact_curvature(find_curvature(*query.shape1, *query.pose1, n) + find_curvature(*query.shape2, *query.pose2, -n),
                                n);
}

/// An ellipsoid that does not deliver its Hessian.
class Reticent : public Shape {
 public:
  explicit Reticent(const Vector3& half_axes) : body_(half_axes) {}
  void evaluate(const Vector3& n, Order /*order*/, Jet& jet) const override { body_.evaluate(n, Order::Point, jet); }

 private:
  Ellipsoid body_;
};

double difference(const ContactCurvature& a, const ContactCurvature& b) {
  return std::abs(a.larger - b.larger) + std::abs(a.smaller - b.smaller);
}

/// A contact with an ellipse of half-axes 1 and b, under a pressure of 1 in its middle, on bodies of modulus 1: Johnson,
/// section 3.3.
struct Ellipse {
  explicit Ellipse(double b) {
    const double e = std::sqrt(1 - b * b);
    const double K = std::comp_ellint_1(e), E = std::comp_ellint_2(e);
    const double A = b / (e * e) * (K - E), B = b / (e * e) * (E / (b * b) - K);  // half of the relative curvature along each axis
    const double force = 2.0 / 3 * std::numbers::pi * b;
    const double round_depth = std::cbrt(9.0 / 16 * force * force * 2 * std::sqrt(A * B));
    ratio = B / A;
    correction = b * K / round_depth;
  }
  double ratio, correction;
};

/// The same by the arithmetic-geometric mean in long double. K - E comes from its sum: the difference would cancel.
struct PreciseEllipse {
  explicit PreciseEllipse(long double b) {
    long double mean = 1, geometric = b, sum = (1 - b) * (1 + b) / 2, weight = 1;
    for (int i = 0; i < 10; ++i) {
      const long double half = (mean - geometric) / 2, next = (mean + geometric) / 2;
      geometric = std::sqrt(mean * geometric);
      mean = next;
      sum += weight * half * half;
      weight *= 2;
    }
    const long double K = std::numbers::pi_v<long double> / (2 * mean), E = K * (1 - sum), e2 = (1 - b) * (1 + b);
    const long double A = b / e2 * K * sum, B = b / e2 * (E / (b * b) - K);
    const long double force = 2.0L / 3 * std::numbers::pi_v<long double> * b;
    ratio = B / A;
    correction = b * K / std::cbrt(9.0L / 16 * force * force * 2 * std::sqrt(A * B));
  }
  long double ratio, correction;
};

/// The rebound velocity of an impact of a unit mass at velocity 1 on F = x^(3/2) with the damper of ratio b, by short Euler steps.
double rebound(double b) {
  constexpr double kEulerStep = 1e-6;
  double x = 0, v = 1;
  while (true) {
    x += kEulerStep * v;
    const double stiffness = 1.5 * std::sqrt(std::fmax(x, 0));
    const double force = x * stiffness / 1.5 + 2 * b * std::sqrt(5.0 / 6 * stiffness) * v;
    if (force <= 0 || x <= 0) return -v;
    v -= kEulerStep * force;
  }
}

}  // namespace

TEST_CASE("at the ends of its axes an ellipsoid has the radii a^2/c and b^2/c") {
  const Vector3 a(3, 2, 0.5);
  const Pose pose{Vector3::Zero(), Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix()};
  const Vector3 n = pose.rotation * Vector3::UnitZ();
  for (const bool tells : {true, false}) {
    const Matrix3 K = tells ? find_curvature(Ellipsoid(a), pose, n) : find_curvature(Reticent(a), pose, n);
    const Matrix3 body = pose.rotation.transpose() * K * pose.rotation;
    CHECK(std::abs(body(0, 0) - 0.5 / 9) < 1e-6);
    CHECK(std::abs(body(1, 1) - 0.5 / 4) < 1e-6);
    CHECK((K * n).norm() < 1e-12);
  }
}

TEST_CASE("the curvatures of two rotated bodies add") {
  const Ellipsoid body(Vector3(2, 1, 1));
  const Pose turned{Vector3::Zero(), Eigen::AngleAxisd(std::acos(0.0), Vector3::UnitZ()).toRotationMatrix()};
  const Vector3 n = Vector3::UnitZ();
  const ContactCurvature crossed = find_contact_curvature(find_curvature(body, {}, n) + find_curvature(body, turned, -n), n);
  CHECK(std::abs(crossed.smaller - 1.25) < 1e-12);
  CHECK(std::abs(crossed.larger - 1.25) < 1e-12);
  const ContactCurvature parallel = find_contact_curvature(2 * find_curvature(body, {}, n), n);
  CHECK(std::abs(parallel.smaller - 0.5) < 1e-12);
  CHECK(std::abs(parallel.larger - 2) < 1e-12);
}

TEST_CASE("a flat face has curvature 0 and an edge a large curvature") {
  const Superellipsoid box(Vector3(1, 1, 1), 50, 50);
  CHECK(find_curvature(box, {}, Vector3::UnitZ()).norm() < 1e-9);
  const Matrix3 edge = find_curvature(box, {}, Vector3(1, 0, 1).normalized());
  const ContactCurvature principal = find_contact_curvature(edge, Vector3(1, 0, 1).normalized());
  CHECK(principal.larger > 10);
  CHECK(principal.smaller < 1e-9);
}

TEST_CASE("a query of many pairs gives the curvatures at their contacts") {
  const Overlaps overlaps;
  const std::vector<ProximityQuery>& queries = overlaps.queries();
  std::vector<Proximity> found(queries.size()), alone(queries.size());
  std::vector<ContactCurvature> curvatures(queries.size());
  {
    const Traps traps("curvatures of many pairs");
    find_proximities(queries, {}, found, curvatures);
  }
  find_proximities(queries, {}, alone);
  int overlapping = 0;
  double worst = 0;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    CAPTURE(k);
    CHECK(found[k].gap == alone[k].gap);
    CHECK(found[k].normal == alone[k].normal);
    if (found[k].gap >= 0) {
      CHECK(curvatures[k].smaller == 0);
      CHECK(curvatures[k].larger == 0);
      continue;
    }
    ++overlapping;
    const ContactCurvature expected = curvature_at(queries[k], found[k].normal);
    // Where a body is nearly flat or sharp, the rounding of the normal changes the curvature by more than its own rounding.
    double spread = 0;
    for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) {
      const Vector3 beside = (found[k].normal + 2 * std::numeric_limits<double>::epsilon() * axis).normalized();
      spread = std::max(spread, difference(curvature_at(queries[k], beside), expected));
    }
    const double error = std::max(difference(curvatures[k], expected) - spread, 0.0);
    worst = std::max(worst, error / std::max(expected.larger, std::numeric_limits<double>::min()));
  }
  MESSAGE("of ", overlapping, " overlaps: ", worst, " of the larger curvature");
  CHECK(overlapping > 1000);
  CHECK(worst < 1e-10);
}

TEST_CASE("the curvatures of many pairs have the same digits in every width") {
  const Overlaps overlaps;
  std::vector<ProximityQuery> queries;
  for (const ProximityQuery& query : overlaps.queries()) {
    if (is_for_lanes(*query.shape1, *query.shape2, {})) queries.push_back(query);
  }
  std::vector<std::vector<ContactCurvature>> all;
  const Settings settings;
  const LaneKernels& kernels = lane_kernels();
  int known = 0;
  for (int k = 0; k < kernels.count; ++k) {
    std::vector<Proximity> found(queries.size());
    std::vector<ContactCurvature>& curvatures = all.emplace_back(queries.size());
    LaneBatch batch(settings, *kernels.kernels[k], found, curvatures);
    for (std::size_t i = 0; i < queries.size(); ++i) batch.add(queries[i], i);
    batch.solve_rest();
    for (std::size_t i = 0; i < queries.size(); ++i) {
      CHECK(curvatures[i].smaller == all[0][i].smaller);
      CHECK(curvatures[i].larger == all[0][i].larger);
      known += k == 0 && curvatures[i].larger > 0 ? 1 : 0;
    }
  }
  MESSAGE(known, " of ", queries.size(), " from the lanes");
  CHECK(known > 500);
}

TEST_CASE("curvatures of another length than the queries are refused") {
  std::vector<ContactCurvature> two(2);
  CHECK_THROWS_AS(find_proximities({}, {}, {}, two), std::invalid_argument);
}

TEST_CASE("Hertz: the correction of elliptic contacts agrees with the elliptic integrals") {
  CHECK(hertz_correction(1) == 1);
  for (const double axes : {0.95, 0.6, 0.2, 0.03, 0.001}) {
    const Ellipse ellipse(axes);
    CAPTURE(ellipse.ratio);
    CHECK(hertz_correction(ellipse.ratio) == relative(ellipse.correction).epsilon(1e-8));
  }
}

TEST_CASE("Hertz: the correction has a relative error of 1e-12, for axes down to 1e-6 of each other") {
  constexpr int kCount = 20000;
  double largest = 0;
  double last = 1;
  for (int k = 1; k <= kCount; ++k) {
    const PreciseEllipse ellipse(std::pow(10.0L, -6.0L * k / kCount));
    const double found = hertz_correction(static_cast<double>(ellipse.ratio));
    largest = std::max(largest, static_cast<double>(std::abs(found / ellipse.correction - 1)));
    CHECK(found <= last + 1e-12);
    last = found;
  }
  MESSAGE("largest relative error: " << largest);
  CHECK(largest < 1e-12);
}

TEST_CASE("Hertz: an impact with the damping for a restitution rebounds with it") {
  CHECK(hertz_damping_ratio(1) == 0);
  for (const double restitution : {0.05, 0.3, 0.6, 0.9, 0.99}) {
    CAPTURE(restitution);
    CHECK(std::abs(rebound(hertz_damping_ratio(restitution)) - restitution) < 2e-4);
  }
}
