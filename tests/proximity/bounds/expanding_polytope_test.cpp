// Tests of deep overlaps: the proofs of the global maximum, and how the hybrid follows a maximum while bodies pass through one
// another.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/reference_pairs.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

Settings certified() {
  Settings settings;
  settings.certify_depth = true;
  return settings;
}

double smallest_radius(const Shape& shape, const Vector3& n) {
  const Jet jet = shape.jet(n);
  const Vector3 t1 = n.unitOrthogonal(), t2 = n.cross(t1);
  const double xx = t1.dot(jet.H * t1), xy = t1.dot(jet.H * t2), yy = t2.dot(jet.H * t2);
  return 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);
}

/// Checks that the bodies are apart; body 1 is at the origin.
void check_apart(const Shape& body1, const Shape& body2, const Pose& pose2) {
  const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
  CHECK(answer.is_global);
  CHECK(answer.gap > 0);
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
        Settings settings;
        settings.solver = solver;
        const Proximity out = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, settings, &n);
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
  Pose pose;
  pose.position = boxy.point(n) - 0.03125 * n - boxy.point(-n);
  const Proximity found = find_proximity(boxy, {}, boxy, pose);
  const Proximity proved = find_proximity(boxy, {}, boxy, pose, certified());
  CHECK(proved.is_global);
  CHECK(proved.gap > -0.031166);
  CHECK(proved.gap < -0.031165);
  CHECK((found.is_global == false || std::abs(found.gap - proved.gap) <= 1e-9));
  CHECK(proved.gap <= found.gap + found.global_error);
}

// The normal of the first climb, 5e-10 m deep, leads into another basin of attraction: the maximum that separates the bodies is 103
// degrees away.
TEST_CASE("a needle's tip on a vertex of another, 7e-11 m apart: where bodies may touch, no normal is left to chance") {
  const std::array<Vector3, 5> points = {Vector3(0.012051518399086192, -0.19603277197672586, 0.74698447795492073),
                                         Vector3(-0.037081459265394953, 0.49587026379843452, 0.3345531509944204),
                                         Vector3(-0.022943379748367337, 0.29853221052642576, -0.65531553626789973),
                                         Vector3(0.029693041168745986, 0.0047201698522631756, -0.63785247806481193),
                                         Vector3(0.022634272672686293, 0.833954313924401, -0.02090210250108604)};
  const Polytope needle(points);
  const Superellipsoid other(Vector3(0.33589502295312529, 2.079589666107458, 0.18992071014211995), 1.0505843814196085,
                             7.6522420671329217);
  Pose pose2{Vector3(0.32926131563088118, 2.5815167761638085, -1.0726527220048339), Matrix3::Identity()};
  pose2.rotation << -0.91202224446929248, -0.12318873633911614, 0.39120322190949069,  //
      0.31679658741664674, -0.81738716501577957, 0.4811633243178805,                  //
      0.26049059060618945, 0.56276350068802317, 0.78450104811848398;
  const Proximity answer = find_proximity(needle, {}, other, pose2, {});
  CHECK(answer.is_global);
  CHECK(std::abs(answer.gap - 6.9003e-11) <= answer.error);
}

// The case is like the one before, but the first climb ends 3e-7 m deep.
TEST_CASE("the edges of two flat needles at one another's ends, 2e-10 m apart: no search ends before the overlap is proved") {
  const Superellipsoid body1(Vector3(0.34214723099492178, 4.9050957934449073, 1.3734996802765909), 1.1442576482855413,
                             86.759944962975169);
  const Superellipsoid body2(Vector3(0.076701942377301269, 0.64845549724886942, 0.56743701898540477), 1.1392353648785363,
                             41.491925853445579);
  const Vector3 turn(1.03658376e-7, -3.37618822e-8, 1.18135856e-7);  // radians
  const Pose pose2{Vector3(3.0025404397791209e-07, -5.5507419937433768, -1.8510334563316457),
                   Matrix3(Eigen::AngleAxisd(turn.norm(), turn.normalized()))};
  check_apart(body1, body2, pose2);
}

// Another basin of attraction, 5e-4 m deep, ends at the vertex of exponent 1.5 of the second body, beside which it is rather round.
TEST_CASE("a needle's end on a flat body's edge, 2e-7 m apart: vertices are not as round as what is beside them") {
  const Superellipsoid body1(Vector3(0.050994107847938411, 0.062385800436830167, 0.64129993118620687), 57.006892184982505,
                             1.0755879941156079);
  const Superellipsoid body2(Vector3(3.9880280438063935, 0.063964474352347159, 2.068312273893171), 1.5060427579036109,
                             6.5163760301934994);
  Pose pose2{Vector3(0.057649194492710887, 2.5249073870580818, 3.9345616723530541), Matrix3::Identity()};
  pose2.rotation << -0.42350580931167703, 0.103487019160247, -0.89996292498335062,  //
      -0.58454385565023337, -0.79017338989960284, 0.18421317736831186,              //
      -0.69206308260217175, 0.60408314887927195, 0.39513572217566306;
  check_apart(body1, body2, pose2);
}

// Another maximum, 1.2e-4 m deep, is no deeper than the bodies are round, as far as the radii of tips can be estimated.
TEST_CASE("a needle's side at a sharp needle's end, 6e-9 m apart: no overlap of tips is believed before it is proved") {
  const Superellipsoid body1(Vector3(0.06209891743239853, 2.135555967510081, 0.11885766610329596), 1.4079099170978948,
                             2.0383562546709681);
  const Superellipsoid body2(Vector3(0.12909933262663925, 0.34113374452979756, 3.6375920199343734), 3.4502209842093361,
                             1.1193644033663821);
  Pose pose2{Vector3(-0.62653784173429927, 4.1165213219548988, -2.9858588562257826), Matrix3::Identity()};
  pose2.rotation << 0.97609593142321882, 0.13257654200135516, -0.17222134934438837,  //
      0.20649711843932411, -0.81287131283282843, 0.54460918909773226,                //
      -0.067791391306674678, -0.56715402606734333, -0.82081705512270431;
  check_apart(body1, body2, pose2);
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
  Settings settings;
  settings.certify_depth = true;
  settings.max_evaluations = 2000;
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
