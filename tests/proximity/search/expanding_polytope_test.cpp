// Tests of deep overlaps: the proofs of the global maximum, and how the hybrid follows a maximum while bodies pass through one
// another.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/reference_pairs.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

Settings certified() { return {.certify_depth = true}; }

double smallest_radius(const Shape& shape, const Vector3& n) {
  const Jet jet = shape.jet(n);
  const Vector3 t1 = n.unitOrthogonal(), t2 = n.cross(t1);
  const double xx = t1.dot(jet.H * t1), xy = t1.dot(jet.H * t2), yy = t2.dot(jet.H * t2);
  return 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);
}

}  // namespace

TEST_CASE("with certify_depth the global maximum of every reference pair is found and proved") {
  int most = 0;
  for (const ReferencePair& pair : reference_pairs()) {
    const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, certified());
    const double rounding = 1e-14 * (std::abs(pair.gap) + pair.surface2.half_axes().maxCoeff());
    const bool is_right = out.is_global && out.status == Status::Converged && out.error <= 1e-9 * pair.unit &&
                          std::abs(out.gap - pair.gap) <= out.error + rounding && out.global_error <= out.error + 1e-9 * pair.unit;
    if (!is_right)
      FAIL_CHECK(pair.name, " gap ", out.gap, " instead of ", pair.gap, " global ", out.is_global, " error ", out.error);
    most = std::max(most, out.evaluations);
  }
  MESSAGE("at most ", most, " evaluations");
  CHECK(most <= 400);
}

TEST_CASE("whatever the start and the solver, a claim to be global is true, and the bound on what is missing holds") {
  const std::vector<Vector3> normals = random_normals(3, 4);
  int claims = 0;
  for (const ReferencePair& pair : reference_pairs()) {
    const double rounding = 1e-14 * (std::abs(pair.gap) + pair.surface2.half_axes().maxCoeff());
    for (const Vector3& n : normals) {
      for (const Solver solver : {Solver::Hybrid, Solver::Newton}) {
        const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, {.solver = solver}, &n);
        if (out.status == Status::InvalidInput) continue;
        claims += out.is_global;
        const double missing = pair.gap - out.gap;
        if (!(missing <= out.global_error + rounding)) FAIL_CHECK(pair.name, " misses ", missing, " bound ", out.global_error);
        if (out.is_global && !(missing <= std::max(out.error, 1e-9 * pair.unit) + rounding))
          FAIL_CHECK(pair.name, " claims too much");
      }
    }
  }
  CHECK(claims > 4000);
}

TEST_CASE("an edge above a parallel edge: the default search does not claim what it does not know") {
  const Superellipsoid boxy({1, 0.8, 0.5}, 60, 60);
  const Vector3 n = Vector3(0, 1, 1).normalized();
  const Pose pose{boxy.point(n) - 0.03125 * n - boxy.point(-n), Matrix3::Identity()};
  const Proximity found = find_proximity(boxy, {}, boxy, pose);
  const Proximity proved = find_proximity(boxy, {}, boxy, pose, certified());
  CHECK(proved.is_global);
  CHECK(proved.gap > -0.031166);
  CHECK(proved.gap < -0.031165);
  CHECK((found.is_global == false || std::abs(found.gap - proved.gap) <= 1e-9));
  CHECK(proved.gap <= found.gap + found.global_error);
}

TEST_CASE("no radius of curvature is smaller than the rolling radius") {
  for (const Superellipsoid& shape : superellipsoids(2, 200)) {
    for (const Vector3& n : random_normals(40, 6)) {
      const double radius = smallest_radius(shape, n);
      if (!(shape.rolling_radius() <= radius * (1 + 1e-9))) FAIL_CHECK(text(shape), " ", radius, " below ", shape.rolling_radius());
    }
    CHECK(shape.rolling_radius() > 0);
  }
  CHECK(Superellipsoid({1, 1, 1}, 2, 2).rolling_radius() == relative(1));
  CHECK(Superellipsoid({1, 1, 1}, 1.9, 4).rolling_radius() == 0);
  CHECK(Ellipsoid({3, 2, 1}).rolling_radius() == relative(1.0 / 3));
}

namespace {

struct Passage {
  int switches = 0, returns = 0;
  double worst_ratio = 1, roughest = 0;
};

/// Moves body 2 through body 1 and follows the normal from step to step.
Passage pass_through(const Shape& shape1, const Shape& shape2, const Vector3& direction, double reach) {
  constexpr int kSteps = 2000;
  constexpr int kCompareEvery = 100;
  constexpr double kTurn = 0.5;  // rad; rotation of the motion over the whole way
  Passage passage;
  std::vector<Vector3> left;
  Proximity before;
  Vector3 normal;
  for (int step = 0; step <= kSteps; ++step) {
    const double way = 2.0 * step / kSteps - 1;
    const Pose pose{reach * way * direction + 0.03 * direction.unitOrthogonal(),
                    Eigen::AngleAxisd(kTurn * way, Vector3(1, 2, 2) / 3).toRotationMatrix()};
    const Proximity now = find_proximity(shape1, {}, shape2, pose, {}, step > 0 ? &normal : nullptr);
    const bool is_overlap = step > 0 && now.gap < 0 && before.gap < 0;
    // One motion moves no point by more than this, nor does it change the gap on one branch by more.
    const double motion = 2 * reach / kSteps + kTurn * 2 / kSteps * shape2.half_extents().norm();
    if (is_overlap && std::abs(now.gap - before.gap) > motion * (1 + 1e-6)) {
      ++passage.switches;
      // The branch was left for a separating translation that is shorter by a sixth only.
      CHECK(now.gap >= before.gap - motion);
      for (const Vector3& n : left) passage.returns += n.dot(now.normal) > 0.97;
      left.push_back(normal);
    }
    if (step % kCompareEvery == 0 && now.gap < -0.02 * shape1.half_extents().minCoeff()) {
      const Proximity best = find_proximity(shape1, {}, shape2, pose, certified());
      CHECK(best.is_global);
      passage.worst_ratio = std::max(passage.worst_ratio, now.gap / best.gap);
    }
    before = now;
    normal = now.normal;
  }
  return passage;
}

}  // namespace

TEST_CASE("bodies that pass through one another keep their normal until another is clearly better") {
  const Superellipsoid boxy({1, 0.7, 0.5}, 12, 20), octahedral({0.8, 0.6, 0.5}, 1.2, 1.2);
  const Ellipsoid needle({2, 0.3, 0.2});
  const Box box({0.7, 0.6, 0.5});
  const Cylinder cylinder(0.5, 0.8);
  for (const Shape* shape1 : std::initializer_list<const Shape*>{&boxy, &octahedral, &needle}) {
    for (const Shape* shape2 : std::initializer_list<const Shape*>{&boxy, &octahedral, &box, &cylinder}) {
      const Passage passage = pass_through(*shape1, *shape2, Vector3(2, -1, 2) / 3, 2.5);
      CHECK(passage.switches <= 4);
      CHECK(passage.returns == 0);
      CHECK(passage.worst_ratio <= 1.5 * (1 + 1e-9));
    }
  }
}

TEST_CASE("thin bodies on one another, whose known points are in planes with the centre: the depth is certified") {
  const Settings settings{.max_evaluations = 2000, .certify_depth = true};
  for (const double thickness : {1e-4, 1e-3, 1e-2, 0.1}) {
    for (const double delta : {1.5, 2.0, 8.0}) {
      const Superellipsoid coin({1, 1, thickness}, delta, 20);
      for (const double beside : {0.0, 0.05, 0.1, 0.2, 0.3, 0.5}) {
        for (const double height : {0.5, 1.0, 1.5, 1.9}) {
          const Pose pose2{{beside, 0, height * thickness}, Matrix3::Identity()};
          const Proximity found = find_proximity(coin, {}, coin, pose2, settings);
          CAPTURE(thickness);
          CAPTURE(delta);
          CAPTURE(beside);
          CAPTURE(height);
          CHECK(found.is_global);
          CHECK(found.gap == relative((height - 2) * thickness).epsilon(1e-9));
        }
      }
    }
  }
}
