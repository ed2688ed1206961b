// Tests of the soak: its samples, the faults that it finds, and its queries over any stack.
#include <doctest/doctest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "examination.hpp"
#include "sample.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "support/draw.hpp"
#include "support/painted_stack.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::soak;
using namespace supernormal::test;

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

constexpr std::uint64_t kSamples = 20000;

const std::uint64_t kStackSamples = draws(4000);

void check_stack(const samples::HardCase& one, const Settings& settings) {
  const Vector3* const start = one.first_normal ? &*one.first_normal : nullptr;
  const auto ask = [&] { return find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings, start); };
  if (!is_same_on_every_stack(ask)) FAIL_CHECK(one.name);
  const Traps traps(one.name.c_str());
  ask_on_painted_stack(kSignallingNan, ask);
}

}  // namespace

TEST_CASE("no violation is reported for two balls, queried in every way") {
  const Finding finding = examine_thoroughly(balls());
  for (const std::string& violation : finding.violations) FAIL_CHECK(violation);
  CHECK(finding.answer.is_global);
}

TEST_CASE("a gap other than the placed gap is reported") {
  for (const double placed : {0.6, 0.4}) {
    Sample sample = balls();
    sample.placed_gap = placed;
    CHECK(is_told(examine_thoroughly(sample), "placed"));
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

TEST_CASE("samples cover the catalogue and the random classes, from apart to one within the other") {
  const SampleSource source(7);
  std::set<std::string> names;
  int apart = 0, touching = 0, shallow = 0, deep = 0;
  Sample sample;
  for (std::uint64_t k = 0; k < kSamples; ++k) {
    source.draw(k, sample);
    names.insert(sample.pair.name);
    REQUIRE(sample.pair.pose2.position.allFinite());
    CHECK((sample.pair.pose2.rotation.transpose() * sample.pair.pose2.rotation - Matrix3::Identity()).norm() <= 1e-14);
    if (!sample.placed_gap) continue;
    const double unit = std::min(sample.pair.shape1->half_extents().minCoeff(), sample.pair.shape2->half_extents().minCoeff());
    const double relative = *sample.placed_gap / unit;
    (relative > 1e-3 ? apart : relative >= -1e-3 ? touching : relative > -0.3 ? shallow : deep) += 1;
  }
  for (const samples::HardCase& one : samples::hard_cases()) {
    if (!names.contains(one.name)) FAIL_CHECK(one.name, " is not drawn");
  }
  CHECK(names.contains("random: extreme_boxy"));
  for (const int count : {apart, touching, shallow, deep}) CHECK(count > 100);
}

TEST_CASE("the sharp mix has only bodies that are sharp in one section and flat in another") {
  const SampleSource source(7, Mix::Sharp);
  int sharp_beside_flat = 0;
  Sample sample;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    source.draw(k, sample);
    CHECK(sample.pair.name == "random: of any exponents");
    for (const samples::Body* body : {&sample.pair.body1, &sample.pair.body2}) {
      const auto [least, largest] = std::minmax(body->delta, body->epsilon);
      sharp_beside_flat += least < 1.3 && largest > 20 ? 1 : 0;
    }
  }
  CHECK(sharp_beside_flat > 50);
}

TEST_CASE("random pairs give the same digits over any stack, and compute nothing with uninitialized memory") {
  for (const Mix mix : {Mix::Everything, Mix::Sharp}) {
    const SampleSource source(22, mix);
    Sample sample;
    for (std::uint64_t index = 0; index < kStackSamples; ++index) {
      source.draw(index, sample);
      check_stack(sample.pair, sample.settings);
    }
  }
}
