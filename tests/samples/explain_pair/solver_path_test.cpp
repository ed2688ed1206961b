// Tests that recorded paths equal the library's evaluations, and that the bounds hold.
#include "method/solver_path.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <supernormal/proximity/solve.hpp>

#include "method/explanation.hpp"
#include "method/recording_shape.hpp"
#include "pair/hard_case.hpp"
#include "pairs.hpp"

using namespace explain_pair;
using namespace supernormal;

namespace {

constexpr double kRounding = 1e-14;  // of numbers near 1

std::vector<Vector3> recorded(const Pair& pair, const Settings& settings) {
  std::vector<Vector3> normals;
  const RecordingShape shape1(*pair.body1.shape, normals);
  find_proximity(shape1, pair.body1.pose, *pair.body2.shape, pair.body2.pose, settings);
  return normals;
}

/// s(n) from the bodies' extents in the world.
double direct_gap(const Pair& pair, const Vector3& n) { return -pair.body1.reach(n) - pair.body2.reach(-n); }

/// `rest`: the number of evaluations after the answer's. Without them only the contact point differs.
void check_only_places(const Pair& pair, Settings settings, const Proximity& answer, int rest) {
  settings.max_evaluations = answer.evaluations - rest;
  const Proximity placeless = find_proximity(*pair.body1.shape, pair.body1.pose, *pair.body2.shape, pair.body2.pose, settings);
  CHECK(placeless.evaluations == settings.max_evaluations);
  CHECK(placeless.status == answer.status);
  CHECK(placeless.gap == answer.gap);
  CHECK(placeless.normal == answer.normal);
  CHECK(placeless.point1 == answer.point1);
  CHECK(placeless.error == answer.error);
  CHECK((placeless.contact == answer.contact) == (rest == 0));
}

void check_path(const Pair& pair, Solver solver) {
  Settings settings;
  settings.solver = solver;
  const SolverPath path = solver_path(pair, settings);
  const Proximity plain = find_proximity(*pair.body1.shape, pair.body1.pose, *pair.body2.shape, pair.body2.pose, settings);
  // Recording changes no digit.
  CHECK(path.answer.gap == plain.gap);
  CHECK(path.answer.normal == plain.normal);
  CHECK(path.answer.point1 == plain.point1);
  CHECK(path.answer.status == plain.status);
  CHECK(path.answer.evaluations == plain.evaluations);
  REQUIRE(path.evaluations.size() == static_cast<std::size_t>(plain.evaluations));

  // The answer is one of the evaluations. For the solvers without a safeguard it is the last one before the evaluations for the
  // contact point.
  const auto is_answer = [&](const Evaluation& one) { return one.s == plain.gap && (one.n - plain.normal).norm() < kRounding; };
  const auto last = std::find_if(path.evaluations.rbegin(), path.evaluations.rend(), is_answer);
  REQUIRE(last != path.evaluations.rend());
  if (solver != Solver::Hybrid) check_only_places(pair, settings, plain, static_cast<int>(last - path.evaluations.rbegin()));
  for (const Evaluation& one : path.evaluations) CHECK(std::abs(one.s - direct_gap(pair, one.n)) < 1e-12);
}

}  // namespace

TEST_CASE("solver path: the path has the library's evaluations and ends at its answer") {
  for (const Pair& pair : sample_pairs()) {
    for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) check_path(pair, solver);
  }
}

TEST_CASE(
    "solver path: the methods of the literature agree with the hybrid if they claim convergence, and draw only superellipsoids") {
  int drawn = 0;
  for (const Pair& pair : sample_pairs()) {
    const Explanation plain = explain(pair, {});
    const Explanation all = explain(pair, {}, Methods::OfLiteratureToo);
    CHECK(all.answer().gap == plain.answer().gap);
    REQUIRE(all.paths.size() >= plain.paths.size());
    for (std::size_t k = plain.paths.size(); k < all.paths.size(); ++k) {
      const SolverPath& path = all.paths[k];
      CAPTURE(path.name);
      CHECK_FALSE(path.solver.has_value());
      for (const Evaluation& one : path.evaluations) CHECK(std::abs(one.s - direct_gap(pair, one.n)) < 1e-12);
      const bool is_found = path.answer.status == Status::Converged;
      if (is_found && plain.answer().gap > 0) CHECK(std::abs(path.answer.gap - plain.answer().gap) < 1e-6);
      ++drawn;
    }
  }
  CHECK(drawn >= 9);
  CHECK(explain(hard_case("colliders: an ellipsoid above a box, gap -0.0625"), {}, Methods::OfLiteratureToo).paths.size() == 1);
}

TEST_CASE("solver path: cuts and intervals contain the answer") {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> gauss;
  for (const Pair& pair : sample_pairs()) {
    const SolverPath path = solver_path(pair, {});
    WorldGap gap(pair);
    const double rolling_radius = gap.function().rolling_radius();
    double highest = path.answer.gap;
    for (int k = 0; k < 300; ++k) {
      const Vector3 n = Vector3(gauss(engine), gauss(engine), gauss(engine)).normalized();
      const double s = gap.s(n);
      highest = std::max(highest, s);
      for (const Evaluation& one : path.evaluations) CHECK(s + rolling_radius <= n.dot(one.cut) + kRounding);
    }
    for (std::size_t k = 0; k < path.intervals.size(); ++k) {
      CHECK(path.intervals[k].upper >= highest - kRounding);
      CHECK(path.intervals[k].lower <= path.answer.gap);
      if (k == 0) continue;
      CHECK(path.intervals[k].upper <= path.intervals[k - 1].upper);
      CHECK(path.intervals[k].evaluations > path.intervals[k - 1].evaluations);
    }
    CHECK(path.intervals.back().evaluations == path.answer.evaluations);
    CHECK(path.intervals.back().lower == path.answer.gap);
    CHECK(path.intervals.back().upper <= path.answer.gap + path.answer.global_error);
    // The region that the cuts leave contains the answer. The answer is below the highest evaluation by at most its own error.
    const double room = room_left(path, path.evaluations.size(), rolling_radius, path.answer.normal);
    CHECK(room >= -path.answer.global_error - kRounding);
  }
}

TEST_CASE("solver path: a path with fewer evaluations is the start of the whole path") {
  for (const Pair& pair : sample_pairs()) {
    const std::vector<Vector3> whole = recorded(pair, {});
    for (std::size_t k = 1; k < std::min<std::size_t>(whole.size(), 30); ++k) {
      Settings settings;
      settings.max_evaluations = static_cast<int>(k);
      const std::vector<Vector3> part = recorded(pair, settings);
      REQUIRE(part.size() == k);
      CHECK(std::equal(part.begin(), part.end(), whole.begin()));
    }
  }
}

TEST_CASE("solver path: bodies with nonsmooth points have a path in either order") {
  for (const char* name :
       {"colliders: an ellipsoid above a box, gap -0.0625", "colliders: an ellipsoid at a box's edge, gap 0.0625"}) {
    const Pair pair = hard_case(name);
    Pair other = pair;
    std::swap(other.body1, other.body2);
    CHECK_FALSE(is_solver_for(Solver::Newton, pair));
    for (const Pair& one : {pair, other}) {
      const Explanation explanation = explain(one, {});
      CHECK(explanation.paths.size() == 1);
      const SolverPath& path = explanation.hybrid();
      CHECK(path.evaluations.size() == static_cast<std::size_t>(path.answer.evaluations));
      for (const Evaluation& evaluation : path.evaluations) CHECK(evaluation.s <= path.answer.gap + kRounding);
      CHECK(path.evaluations.back().n.dot(path.answer.normal) > 0.99);
    }
  }
}
