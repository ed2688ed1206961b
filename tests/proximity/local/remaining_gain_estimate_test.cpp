// The estimate of what an ascent has still to gain, of sequences whose sum is known.
#include "proximity/local/remaining_gain_estimate.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "relative.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

using namespace supernormal;
using test::relative;

namespace {

constexpr double kTolerance = 1e-9;  // m
constexpr double kRadius = 1;        // of the trust region
// The sum of the slowest series that is believed, with the safety.
constexpr double kMost = RemainingGainEstimate::kSafety * 20;

constexpr Symmetric2 kUnit{1, 0, 1};  // m

/// m
constexpr Symmetric2 alike(double curvature) { return {curvature, 0, curvature}; }

const Sphere kBall(1);
const GapFunction kGap(kBall, {}, kBall, {Vector3(1.9, 0, 0), Matrix3::Identity()});

}  // namespace

TEST_CASE("gains that shrink by the same factor are summed") {
  for (const double contraction : {1e-3, 0.1, 0.5}) {
    RemainingGainEstimate to_come(kGap, kTolerance);
    to_come.restart();
    CHECK(to_come.learn({1e-4, 1e-4, kUnit}, kRadius) == relative(kMost * 1e-4));  // nothing has been shown
    const double gain = contraction * 1e-4;
    const double sum = gain / (1 - contraction);
    CHECK(to_come.learn({gain, contraction * 1e-4, kUnit}, kRadius) == relative(RemainingGainEstimate::kSafety * sum));
    CHECK_FALSE(to_come.steps_grow());
  }
}

TEST_CASE("steps that hardly shrink are not believed to go on shrinking") {
  RemainingGainEstimate to_come(kGap, kTolerance);
  to_come.restart();
  to_come.learn({1e-6, 1e-4, kUnit}, kRadius);
  CHECK(to_come.learn({1e-7, 0.7e-4, kUnit}, kRadius) == relative(kMost * 1e-7));  // goes on in any case
  CHECK(to_come.learn({1e-12, 0.5e-4, kUnit}, kRadius) == relative(10 * kMost * 1e-12));
}

TEST_CASE("steps that shrink more slowly than the gains tell the contraction, and so do curvatures that change") {
  RemainingGainEstimate to_come(kGap, kTolerance);
  to_come.restart();
  to_come.learn({1e-4, 1e-4, kUnit}, kRadius);
  CHECK(to_come.learn({1e-6, 0.5e-4, kUnit}, kRadius) == relative(RemainingGainEstimate::kSafety * 2 * 1e-6));
  CHECK(to_come.learn({1e-8, 0.5e-6, alike(4)}, kRadius) == relative(RemainingGainEstimate::kSafety * 4 / (1 - 1e-2) * 1e-8));
  // A hundred times another curvature: more than the slowest series, all the more where that would end the climb.
  CHECK(to_come.learn({1e-10, 0.5e-8, alike(400)}, kRadius) == relative(kMost * 1e-10));
  CHECK(to_come.learn({1e-12, 0.5e-10, alike(4)}, kRadius) == relative(10 * kMost * 1e-12));
}

TEST_CASE("a curvature that changes one way counts, however little of the whole it is") {
  RemainingGainEstimate to_come(kGap, kTolerance);
  const auto learn_after = [&](const Symmetric2& before, const Symmetric2& now) {
    to_come.restart();
    to_come.learn({1e-4, 1e-4, before}, kRadius);
    return to_come.learn({1e-6, 1e-6, now}, kRadius);
  };
  const double sum = RemainingGainEstimate::kSafety / (1 - 1e-2) * 1e-6;
  CHECK(learn_after({1, 0, 0.1}, {0.95, 0, 0.4}) == relative(4 * sum));
  CHECK(learn_after({1, 0, 0.1}, {0.1, 0, 1}) == relative(sum));  // turned
  CHECK(learn_after({1, 0.9, 1}, {1, 0, 1}) == relative(10 * sum));
  // Less than the rounding of the flat one says nothing.
  CHECK(learn_after({1, 0, 1e-16}, {1, 0, 1e-18}) == relative(sum));
}

TEST_CASE("a gain below rounding is believed to be the last one, but not of a curvature that has just changed") {
  const double gain = 0.1 * kGap.rounding();
  RemainingGainEstimate to_come(kGap, kTolerance);
  const auto learn_after_a_step = [&](double step, double curvature) {
    to_come.restart();
    to_come.learn({1e-6, 1e-4, kUnit}, kRadius);
    return to_come.learn({gain, step, alike(curvature)}, kRadius);
  };
  CHECK(learn_after_a_step(1e-5, 10) == relative(RemainingGainEstimate::kSafety * gain));
  CHECK(learn_after_a_step(1e-5, 100) == relative(10 * kMost * gain));
  // Of two normals this near each other even another curvature is rounding.
  CHECK(learn_after_a_step(1e-15, 100) == relative(RemainingGainEstimate::kSafety * gain));
}

TEST_CASE("no contraction is believed of long steps, of those at the rim of the trust region, and after one that did not rise") {
  const double gain = 1e-6;
  for (const double step : {2e-3, 0.99e-5}) {
    RemainingGainEstimate to_come(kGap, kTolerance);
    to_come.restart();
    to_come.learn({1e-4, 1e-2, kUnit}, kRadius);
    CHECK(to_come.learn({gain, step, kUnit}, 1e-5) == relative(kMost * gain));
  }
  RemainingGainEstimate to_come(kGap, kTolerance);
  to_come.restart();
  to_come.learn({1e-4, 1e-4, kUnit}, kRadius);
  to_come.forget();
  CHECK(to_come.learn({gain, 1e-6, kUnit}, kRadius) == relative(kMost * gain));
}

TEST_CASE("towards a sharp tip more may come than the slowest series says") {
  const Superellipsoid tip(Vector3(1, 1, 1), 1.1, 1.1);
  const GapFunction gap(tip, {}, kBall, {Vector3(1.9, 0, 0), Matrix3::Identity()});
  RemainingGainEstimate to_come(gap, kTolerance);
  to_come.restart();
  CHECK(to_come.learn({1e-12, 1e-2, kUnit}, kRadius) == relative(10 * kMost * 1e-12));
  to_come.restart();
  CHECK(to_come.learn({1e-6, 1e-2, kUnit}, kRadius) == relative(kMost * 1e-6));  // goes on in any case
}

TEST_CASE("towards a sharp tip no fast contraction is believed while the curvature fades") {
  const Superellipsoid tip(Vector3(1, 1, 1), 1.1, 1.1);
  const GapFunction gap(tip, {}, kBall, {Vector3(1.9, 0, 0), Matrix3::Identity()});
  RemainingGainEstimate to_come(gap, kTolerance);
  const auto learn_of_curvature = [&](const Symmetric2& curvature) {
    to_come.restart();
    to_come.learn({1e-10, 1e-4, kUnit}, kRadius);
    return to_come.learn({1e-12, 1e-6, curvature}, kRadius);
  };
  const double sum = RemainingGainEstimate::kSafety / (1 - 1e-2) * 1e-12;
  CHECK(learn_of_curvature(alike(1 / 1.5)) == relative(1.5 * sum));
  CHECK(learn_of_curvature(alike(2.5)) == relative(2.5 * sum));
  CHECK(learn_of_curvature(alike(1 / 2.5)) == relative(10 * 2.5 * sum));
  CHECK(learn_of_curvature({1, 0, 1 / 2.5}) == relative(10 * 2.5 * sum));
}

TEST_CASE("towards a sharp tip a gain below rounding is not the last one of a step held back or a long one") {
  const Superellipsoid tip(Vector3(1, 1, 1), 1.1, 1.1);
  const GapFunction gap(tip, {}, kBall, {Vector3(1.9, 0, 0), Matrix3::Identity()});
  const double gain = 0.1 * gap.rounding();
  RemainingGainEstimate to_come(gap, kTolerance);
  to_come.restart();
  CHECK(to_come.learn({gain, 1e-6, kUnit}, 1e-5) == relative(kMost * gain));
  to_come.restart();
  CHECK(to_come.learn({gain, 1e-5, kUnit}, 1e-5) == relative(10 * kMost * gain));
  to_come.restart();
  CHECK(to_come.learn({gain, 2e-3, kUnit}, kRadius) == relative(10 * kMost * gain));
}

TEST_CASE("steps that grow, and slow steps in a row, are told") {
  RemainingGainEstimate to_come(kGap, kTolerance);
  to_come.restart();
  double gain = 1e-4;
  for (int k = 0; k < 4; ++k) {
    to_come.learn({gain, 1e-4 * (k + 1), kUnit}, kRadius);
    CHECK(to_come.steps_grow() == (k > 0));
    CHECK_FALSE(to_come.may_zigzag());
    gain *= 0.9;
  }
  to_come.learn({gain, 1e-4, kUnit}, kRadius);
  CHECK(to_come.may_zigzag());
  CHECK_FALSE(to_come.may_zigzag());
}

TEST_CASE("a model without a maximum promises no end, and is no history") {
  RemainingGainEstimate to_come(kGap, kTolerance);
  to_come.restart();
  CHECK(to_come.learn({std::numeric_limits<double>::infinity(), 0.5, kUnit}, kRadius) == std::numeric_limits<double>::infinity());
  CHECK(to_come.learn({1e-6, 1e-6, kUnit}, kRadius) == relative(kMost * 1e-6));
}

TEST_CASE("a slope that falls like the square of the distance to a shelf is told from one that falls to a maximum") {
  RemainingGainEstimate to_come(kGap, kTolerance);
  const auto is_shelf_after = [&](double before, double now, double step) {
    to_come.restart();
    to_come.learn({1e-6, 1e-2, {1, 0, before}}, kRadius);
    CHECK_FALSE(to_come.near_degenerate_stationary_point());
    to_come.learn({1e-7, step, {now, 0, 1}}, kRadius);
    return to_come.near_degenerate_stationary_point();
  };
  CHECK(is_shelf_after(0.5, 0.25, 0.5e-2));        // halfway
  CHECK_FALSE(is_shelf_after(0.5, 0.25, 0.2e-2));  // ends after five such steps
  CHECK_FALSE(is_shelf_after(0.25, 0.5, 1e-2));
  CHECK_FALSE(is_shelf_after(0.5, 0.5, 1e-2));
}

TEST_CASE("a shelf is still suspected after a step that did not rise, but not of a gain below rounding") {
  RemainingGainEstimate to_come(kGap, kTolerance);
  const auto is_suspected_after = [&](double gain) {
    to_come.restart();
    to_come.learn({1e-6, 1e-2, {1, 0, 0.5}}, kRadius);
    to_come.learn({1e-7, 0.5e-2, {0.25, 0, 1}}, kRadius);
    CHECK(to_come.near_degenerate_stationary_point());
    to_come.forget();
    to_come.learn({gain, 0.5e-2, {0.25, 0, 1}}, kRadius);
    return to_come.near_degenerate_stationary_point();
  };
  CHECK(is_suspected_after(1e-7));
  CHECK_FALSE(is_suspected_after(0.1 * kGap.rounding()));
  to_come.restart();
  to_come.learn({1e-7, 0.5e-2, {0.25, 0, 1}}, kRadius);
  CHECK_FALSE(to_come.near_degenerate_stationary_point());
}

TEST_CASE("a curvature that ends soon along the step is not believed, though another was the least before") {
  const auto promised = [](double gain, double step, double along, double across) {
    const TangentPlane plane(Vector3::UnitZ(), Vector3::UnitX());
    return RemainingGainEstimate::Promise{gain, step, {along, 0, across}, plane, Vector2::UnitX()};
  };
  const auto learned = [&](double along, double across) {
    RemainingGainEstimate to_come(kGap, kTolerance);
    to_come.restart();
    to_come.learn(promised(1e-8, 1e-4, 0.9, 0.7), kRadius);
    return to_come.learn(promised(1e-10, 0.5e-4, along, across), kRadius);
  };
  CHECK(learned(0.9, 0.5) == relative(RemainingGainEstimate::kSafety * 2 * (0.7 / 0.5) * 1e-10));  // across
  CHECK(learned(0.5, 0.7) == relative(kMost * 1e-10));
}
