// Tests that the soak program finds real faults.
#include "examination.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "supernormal/shapes/ellipsoid.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::soak;

namespace {

/// Two balls of 1 m, apart by 0.5 m.
Sample balls() {
  Sample sample;
  sample.pair.body1 = sample.pair.body2 = samples::ellipsoid(Vector3::Ones());
  sample.pair.shape1 = sample.pair.shape2 = samples::make_shape(sample.pair.body1);
  sample.pair.pose2.position = {2.5, 0, 0};
  sample.placed_gap = 0.5;
  return sample;
}

Finding examine_thoroughly(const Sample& sample) { return examine(sample, Random(1, 1), Care::All); }

bool is_told(const Finding& finding, const std::string& what) {
  return std::ranges::any_of(finding.violations, [&](const std::string& text) { return text.find(what) != std::string::npos; });
}

/// A ball with arbitrary changes to its jets.
class Liar : public Shape {
 public:
  explicit Liar(std::function<void(const Vector3& n, Jet& jet)> lie) : lie_(std::move(lie)) {}

  void evaluate(const Vector3& n, Order order, Jet& jet) const override {
    ball_.evaluate(n, order, jet);
    lie_(n, jet);
  }
  ShapeTraits traits() const override { return {.has_hessian = true}; }
  Vector3 half_extents() const override { return Vector3::Ones(); }

 private:
  Ellipsoid ball_{Vector3::Ones()};
  std::function<void(const Vector3& n, Jet& jet)> lie_;
};

Finding examine_liar(const std::function<void(const Vector3& n, Jet& jet)>& lie) {
  Sample sample = balls();
  sample.placed_gap.reset();
  sample.pair.shape2 = std::make_shared<Liar>(lie);
  return examine_thoroughly(sample);
}

}  // namespace

TEST_CASE("no violation is reported for two balls, queried in every way") {
  const Finding finding = examine_thoroughly(balls());
  for (const std::string& violation : finding.violations) FAIL_CHECK(violation);
  CHECK(finding.queries >= 11);
  CHECK(finding.is_global);
  CHECK(finding.is_converged);
  CHECK(finding.error_of_bound <= 1);
}

TEST_CASE("a gap other than the placed gap is reported") {
  for (const double placed : {0.6, 0.4}) {
    Sample sample = balls();
    sample.placed_gap = placed;
    const Finding finding = examine_thoroughly(sample);
    CHECK(is_told(finding, "placed"));
    CHECK(finding.error_of_bound > 1);
    CHECK(finding.error == test::relative(0.1));
  }
}

TEST_CASE("a query that raises a floating-point exception is reported") {
  CHECK(is_told(examine_liar([](const Vector3&, Jet&) { std::feraiseexcept(FE_INVALID); }), "invalid operation"));
  CHECK(is_told(examine_liar([](const Vector3&, Jet&) { std::feraiseexcept(FE_DIVBYZERO); }), "division by zero"));
  CHECK(is_told(examine_liar([](const Vector3&, Jet&) { std::feraiseexcept(FE_OVERFLOW); }), "overflow"));
}

TEST_CASE("points off the surface and numbers that are not finite are reported") {
  CHECK(is_told(examine_liar([](const Vector3&, Jet& jet) { jet.r *= 1.01; }), "point 2"));
  CHECK(is_told(examine_liar([](const Vector3&, Jet& jet) { jet.h = std::numeric_limits<double>::quiet_NaN(); }), "no answer"));
}

TEST_CASE("a maximum that is not the highest is reported") {
  // The body has a dent that the ascent does not see. At the sides it is thinner than its points and radii of curvature say.
  const Finding finding = examine_liar([](const Vector3& n, Jet& jet) { jet.h -= std::abs(n.y()) > 0.1 ? 2 : 0; });
  CHECK_FALSE(finding.violations.empty());
}
