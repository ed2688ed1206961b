// Searches of a whole arc against dense sampling. Bodies with edges have several maxima there.
#include "contact/mesh/arc_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "support/draw.hpp"
#include "support/mesh_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kSamples = 4000;

// The highest sample that is not at an end.
double highest_inside(const Arc& arc, SupportProbe& probe) {
  double highest = -std::numeric_limits<double>::infinity();
  for (int i = 1; i < kSamples; ++i) highest = std::max(highest, arc.sample(arc.end * i / kSamples, probe).gap);
  return highest;
}

}  // namespace

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

TEST_CASE("an arc that its ends rule out costs no evaluation") {
  const Ellipsoid ball(Vector3::Ones());
  SupportProbe probe(ball, Matrix3::Identity());
  Arc arc;
  arc.end = 0.5 * std::numbers::pi;
  arc.edge_point = {-0.9, 0.1, 0};
  ArcSample low = arc.sample(0, probe);
  ArcSample high = arc.sample(arc.end, probe);
  const int before = probe.evaluations();
  REQUIRE(low.gap < -0.05);
  CHECK(!find_higher_maximum(probe, arc, low, high, -1e-3, 1e-11));
  CHECK(probe.evaluations() == before);
}
