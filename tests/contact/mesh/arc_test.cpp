// A body over one edge, against dense sampling of the angle.
#include "contact/mesh/arc.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "supernormal/shapes/polytope.hpp"
#include "support/draw.hpp"
#include "support/mesh_samples.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

Arc random_arc(Draw& draw) {
  const Matrix3 frame = draw.rotation();
  return {.from = frame.col(0), .towards = frame.col(1), .end = draw.uniform(0.1, std::numbers::pi)};
}

double highest_sample(const Arc& arc, SupportProbe& probe) {
  double highest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 2000; ++i) highest = std::max(highest, arc.sample(arc.end * i / 2000, probe).gap);
  return highest;
}

constexpr int kSamples = 4000;

// The highest sample that is not at an end.
double highest_inside(const Arc& arc, SupportProbe& probe) {
  double highest = -std::numeric_limits<double>::infinity();
  for (int i = 1; i < kSamples; ++i) highest = std::max(highest, arc.sample(arc.end * i / kSamples, probe).gap);
  return highest;
}

}  // namespace

TEST_CASE("the slope over an arc is the derivative of the gap") {
  Draw draw(11);
  const Ellipsoid body({1, 0.7, 0.5});
  for (int i = 0; i < 100; ++i) {
    Arc arc = random_arc(draw);
    arc.edge_point = draw.in_box({0.5, 0.5, 0.5});
    SupportProbe probe(body, draw.rotation());
    const double angle = draw.uniform(0.01, arc.end - 0.01);
    const double step = 1e-5;
    const double difference = (arc.sample(angle + step, probe).gap - arc.sample(angle - step, probe).gap) / (2 * step);
    CHECK(std::abs(arc.sample(angle, probe).slope - difference) < 1e-8);
  }
}

TEST_CASE("the maximum over an arc agrees with dense sampling, and a search that ends early is off by at most its error") {
  Draw draw(12);
  int maxima = 0, unfinished = 0;
  for (int i = 0; i < draws(3000); ++i) {
    CAPTURE(i);
    const std::unique_ptr<Shape> body = draw_body(draw);
    SupportProbe probe(*body, draw.rotation());
    Arc arc = random_arc(draw);
    // The edge is placed so that the gap along the normal in the middle has this value, and the point is nearly over the edge.
    const ArcSample middle = arc.sample(0.5 * arc.end, probe);
    arc.edge_point = middle.point + draw.uniform(0, 0.03) * arc.normal(0.5 * arc.end) + 0.02 * draw.direction();
    const ArcSample low = arc.sample(0, probe);
    const ArcSample high = arc.sample(arc.end, probe);
    if (!have_maximum_between(low, high, 1e-12)) continue;
    const double highest = highest_sample(arc, probe);
    const int before = probe.evaluations();
    const ArcMaximum found = maximize_between(probe, arc, low, high, 1e-11, 1000);
    CHECK(probe.evaluations() - before <= 80);
    if (found.is_apart) {
      CHECK(highest > -1e-5);
      continue;
    }
    ++maxima;
    CHECK(found.converged);
    CHECK(found.error <= 1e-11);
    CHECK(found.gap <= 1e-11);
    // The maximum is local and over the edge: projected along the normal, the point is on the edge's line.
    CHECK(std::abs(found.normal.dot(found.point - arc.edge_point) - found.gap) < 1e-14);
    CHECK(std::abs(arc.from.cross(arc.towards).cross(found.normal).dot(found.point - arc.edge_point)) < 1e-9);
    // One arc in 4000 also has another maximum, which is lower than an end.
    CHECK(found.gap >= std::max(low.gap, high.gap));
    // The body is nowhere deeper.
    CHECK(std::abs(probe.deepest(found.normal).height - found.normal.dot(found.point)) < 2e-11);
    // It is also the highest if there is only one.
    const auto* const ellipsoid = dynamic_cast<const Ellipsoid*>(body.get());
    if (ellipsoid == nullptr) continue;
    CHECK(found.gap >= highest - 1e-11);
    // A search that ends early says how much it may miss.
    const ArcMaximum rough = maximize_between(probe, arc, low, high, 1e-11, i % 4);
    if (rough.is_apart) continue;
    unfinished += !rough.converged;
    CHECK(std::abs(found.gap - rough.gap) <= rough.error + 2e-11);
  }
  CHECK(maxima > 500);
  CHECK(unfinished > 100);
}

TEST_CASE("a flat side across an edge touches in the point over the edge") {
  const Superellipsoid body({1, 1, 0.5}, 200, 200);
  SupportProbe probe(body, Matrix3::Identity());
  // The other normal is (0.6, 0, 0.8).
  const Arc arc{.from = {-0.6, 0, 0.8}, .towards = {0.8, 0, 0.6}, .end = std::acos(0.28), .edge_point = {0.3, 0, -0.45}};
  const ArcMaximum found = maximize_between(probe, arc, arc.sample(0, probe), arc.sample(arc.end, probe), 1e-11, 1000);
  REQUIRE(!found.is_apart);
  CHECK(found.gap == relative(-0.05));
  CHECK((found.normal - Vector3::UnitZ()).norm() < 1e-6);
  CHECK(found.point.x() == relative(0.3).epsilon(1e-6));
  CHECK(found.point.z() == relative(-0.5).epsilon(1e-6));
}

TEST_CASE("where the gap rises at both ends of an arc, the maximum before the lower end is found") {
  // Two points, whose gaps are -cos(angle + 0.1) and -1.1 cos(angle - 1.1): from the first to the second they rise, fall, and rise
  // again.
  const Vector3 points[] = {{-std::cos(-0.1), -std::sin(-0.1), 0}, {-1.1 * std::cos(1.1), -1.1 * std::sin(1.1), 0}};
  const Polytope body(points);
  SupportProbe probe(body, Matrix3::Identity());
  const Arc arc{.end = 1.2};
  const ArcSample low = arc.sample(0, probe), high = arc.sample(arc.end, probe);
  REQUIRE((low.slope > 0 && high.slope > 0 && high.gap < low.gap));
  const ArcMaximum found = maximize_between(probe, arc, low, high, 1e-13, 1000);
  const double equal = std::atan2(std::cos(0.1) - 1.1 * std::cos(1.1), std::sin(0.1) + 1.1 * std::sin(1.1));
  CHECK(found.converged);
  CHECK(found.gap == relative(-std::cos(equal + 0.1)).epsilon(1e-12));
}

TEST_CASE("the search of an arc finds a higher maximum exactly if there is one") {
  Draw draw(71);
  int found_count = 0;
  int other_count = 0;
  for (int i = 0; i < draws(1000); ++i) {
    CAPTURE(i);
    const std::unique_ptr<Shape> body = draw_body(draw);
    SupportProbe probe(*body, draw.rotation());
    const Matrix3 frame = draw.rotation();
    Arc arc{frame.col(0), frame.col(1), draw.uniform(0.3, std::numbers::pi), Vector3::Zero()};
    const double middle_angle = draw.uniform(0.1, 0.9) * arc.end;
    arc.edge_point = arc.sample(middle_angle, probe).point + draw.uniform(0.05, 0.4) * arc.normal(middle_angle);
    const ArcSample first = arc.sample(0, probe);
    const ArcSample last = arc.sample(arc.end, probe);
    if (!(first.gap <= 0 && last.gap <= 0)) continue;
    const double highest = highest_inside(arc, probe);
    const double ends = std::max(first.gap, last.gap);
    const double known = draw.uniform(0, 1) < 0.5 ? -std::numeric_limits<double>::infinity() : highest + draw.uniform(-1, 1) * 0.01;
    ArcSample low = first;
    ArcSample high = last;
    const int before = probe.evaluations();
    const bool is_found = find_higher_maximum(probe, arc, low, high, known, 1e-11);
    CHECK(probe.evaluations() - before <= 62);
    if (highest > 0) {
      CHECK(!is_found);  // the bodies are apart
      continue;
    }
    if (!is_found) {
      CHECK(highest <= std::max(known, ends) + 1e-11);
      continue;
    }
    ++found_count;
    REQUIRE(have_maximum_between(low, high, 0));
    const ArcMaximum top = maximize_between(probe, arc, low, high, 1e-11, 1000);
    if (top.is_apart) continue;
    CHECK(top.converged);
    CHECK(top.gap > std::max(known, ends));
    CHECK(top.gap >= highest - 1e-11);
    if (!have_maximum_between(first, last, 0)) {
      ++other_count;
      continue;
    }
    const ArcMaximum local = maximize_between(probe, arc, first, last, 1e-11, 1000);
    if (!local.is_apart && local.gap < top.gap - 1e-9) ++other_count;
  }
  CHECK(found_count > draws(200));
  CHECK(other_count > draws(10));
}

// Each point alone is deeper the farther the normal turns from it. So the gap of two points is highest where they are equally deep.
TEST_CASE("the bound between two samples of an arc is the highest gap of a body of their two points") {
  Draw draw(72);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    CAPTURE(i);
    Arc arc = random_arc(draw);
    const std::array<Vector3, 2> points = {draw.in_box({1, 1, 1}), draw.in_box({1, 1, 1})};
    const Polytope body(points);
    SupportProbe probe(body, Matrix3::Identity());
    arc.edge_point = 2 * arc.normal(draw.uniform(0, arc.end));  // beyond the points
    ArcSample low = arc.sample(0, probe), high = arc.sample(arc.end, probe);
    const Vector3 chord = points[0] - points[1];
    const double angle = std::atan2(-arc.from.dot(chord), arc.towards.dot(chord));
    const double equal = angle < 0 ? angle + std::numbers::pi : angle, highest = arc.sample(equal, probe).gap;
    if (equal >= arc.end || highest > 0 || highest < std::max(low.gap, high.gap) + 1e-6) continue;
    ++found;
    CHECK(find_higher_maximum(probe, arc, low, high, highest - 1e-9, 1e-12));
    CHECK(std::abs(std::max(low.gap, high.gap) - highest) <= 1e-9);
  }
  CHECK(found > 40);
}

TEST_CASE("an arc that its ends rule out costs no evaluation") {
  const Ellipsoid ball(Vector3::Ones());
  SupportProbe probe(ball, Matrix3::Identity());
  const Arc arc{.end = 0.5 * std::numbers::pi, .edge_point = {-0.9, 0.1, 0}};
  ArcSample low = arc.sample(0, probe);
  ArcSample high = arc.sample(arc.end, probe);
  const int before = probe.evaluations();
  REQUIRE(low.gap < -0.05);
  CHECK(!find_higher_maximum(probe, arc, low, high, -1e-3, 1e-11));
  CHECK(probe.evaluations() == before);
}
