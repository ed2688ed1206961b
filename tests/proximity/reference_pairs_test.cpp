// The hybrid solver against 1600 pairs with known answers, none excluded: the contract.
#include "support/reference_pairs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <random>

#include "proximity/collider_reference.hpp"
#include "proximity/local/local_model.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/draw.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// Smallest value that `share` of the values do not exceed.
int percentile(std::vector<int> values, double share) {
  REQUIRE_FALSE(values.empty());
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  return values[static_cast<std::size_t>(std::max(std::ceil(share * count) - 1, 0.0))];
}

bool has_sharp_edges(const std::string& kind) { return kind == "extreme_boxy" || kind == "octahedral"; }

/// The reference was computed in 80 bits from the same numbers, but here the rotation is a rounded matrix.
double reference_rounding(const ReferencePair& pair) {
  return std::numeric_limits<double>::epsilon() * (std::abs(pair.gap) + pair.surface2.half_axes().maxCoeff());
}

using Evaluations = std::map<std::string, std::vector<int>>;  // by class

/// Limits on medians; spheres and needles are in no promise but are ellipsoids. "Mixed" has exponents from octahedral to boxy.
const std::map<std::string, int> kMedianLimits = {{"sphere", 5}, {"ellipsoid", 5},    {"needle_disk", 5}, {"moderate", 6},
                                                  {"boxy", 8},   {"extreme_boxy", 8}, {"octahedral", 10}, {"mixed", 10}};

/// One at `pair`, as a time step earlier would have left it: moved by 1e-3 of the smallest half-axis and rotated by 1e-3.
Pose nearby(const ReferencePair& pair, std::mt19937_64& engine) {
  std::normal_distribution<double> gauss;
  const Vector3 shift = Vector3{gauss(engine), gauss(engine), gauss(engine)}.normalized();
  const Vector3 axis = Vector3{gauss(engine), gauss(engine), gauss(engine)}.normalized();
  Pose pose = pair.pose2;
  pose.position += 1e-3 * pair.unit * shift;
  pose.rotation = Eigen::AngleAxisd(1e-3, axis) * pose.rotation;
  return pose;
}

}  // namespace

TEST_CASE("the reference file is complete, and its groups are what they are taken for") {
  REQUIRE(reference_pairs().size() == 1600);
  std::map<std::string, int> counts;
  for (const ReferencePair& pair : reference_pairs()) {
    ++counts[pair.kind];
    // Several ways to separate make a gap larger than nominal, never smaller; only overlaps have several.
    const double excess = pair.gap / pair.unit - pair.nominal;
    const bool as_made = std::abs(excess) < 1e-12 || (pair.nominal < 0 && excess > 0 && pair.gap < 0);
    if (!as_made) FAIL_CHECK(pair.name, " gap ", pair.gap / pair.unit, " nominal ", pair.nominal);
  }
  CHECK(counts.size() == 8);
  for (const auto& entry : counts) CHECK_MESSAGE(entry.second == 200, entry.first);
}

TEST_CASE("cold hybrid: every gap of the reference pairs") {
  int missed = 0;
  double worst = 0;
  for (const ReferencePair& pair : reference_pairs()) {
    const Proximity out = solve(pair);
    const double error = std::abs(out.gap - pair.gap);
    if (out.status != Status::Converged) FAIL_CHECK(pair.name, " status ", static_cast<int>(out.status));
    if (!(error <= out.error + reference_rounding(pair))) FAIL_CHECK(pair.name, " error ", error, " reported ", out.error);
    if (!(out.error <= 1e-9 * pair.unit)) FAIL_CHECK(pair.name, " reported error ", out.error);
    worst = std::max(worst, error / pair.unit);
    if (!(error <= 1e-9 * pair.unit)) {
      ++missed;
      MESSAGE(pair.name, " nominal ", pair.nominal, ": gap ", out.gap, " instead of ", pair.gap);
    }
  }
  MESSAGE("largest error of the gap: ", worst, " of the smallest half-axis");
  // Promised is less for deep overlaps of sharp bodies (up to 0.5 % may miss the global maximum); none misses.
  CHECK(missed == 0);
}

TEST_CASE("cold hybrid: numbers of evaluations") {
  Evaluations near, all;
  for (const ReferencePair& pair : reference_pairs()) {
    const int evaluations = solve(pair).evaluations;
    if (pair.is_apart_or_touching()) near[pair.kind].push_back(evaluations);
    if (pair.nominal >= -0.1) all[pair.kind].push_back(evaluations);
  }
  for (const auto& entry : kMedianLimits) {
    const std::string& kind = entry.first;
    const int limit = entry.second;
    const int median = percentile(near[kind], 0.5);
    const int most = percentile(all[kind], 0.99);
    MESSAGE(kind, ": median ", median, " apart or touching, 99th percentile ", most, " up to 10 % overlap");
    CHECK_MESSAGE(median <= limit, kind);
    // Those of overlaps deeper than the least radius of curvature are a search for other maxima.
    CHECK_MESSAGE(most <= (has_sharp_edges(kind) ? 120 : 60), kind);
  }
}

TEST_CASE("warm hybrid: two or three evaluations from the answer of a pose 1e-3 away") {
  std::mt19937_64 engine(7);
  Evaluations near;
  for (const ReferencePair& pair : reference_pairs()) {
    const Vector3 earlier = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, nearby(pair, engine)).normal;
    const Proximity out = solve(pair, {}, &earlier);
    const double error = std::abs(out.gap - pair.gap);
    if (out.status != Status::Converged) FAIL_CHECK(pair.name, " status ", static_cast<int>(out.status));
    // With several maxima the one of the earlier pose is followed: the answer may be lower, up to what is unquestioned.
    if (pair.nominal >= 0 && !(error <= out.error + reference_rounding(pair)))
      FAIL_CHECK(pair.name, " error ", error, " reported ", out.error);
    if (!(out.gap <= pair.gap + out.error + reference_rounding(pair)))
      FAIL_CHECK(pair.name, " gap ", out.gap, " above the maximum");
    if (pair.is_apart_or_touching()) near[pair.kind].push_back(out.evaluations);
  }
  for (const auto& entry : near) {
    const std::string& kind = entry.first;
    const std::vector<int>& counts = entry.second;
    MESSAGE(kind, ": median ", percentile(counts, 0.5), ", 99th percentile ", percentile(counts, 0.99));
    // On a face that is nearly flat a third one closes the bound, where the slope already promised no more.
    // Vertices that touch take two more, which prove whether they overlap.
    CHECK_MESSAGE(percentile(counts, 0.5) <= (kind == "octahedral" ? 4 : kind == "extreme_boxy" ? 3 : 2), kind);
  }
}

TEST_CASE("witness points lie on both boundaries, have the normal, and are a gap apart along it") {
  for (const ReferencePair& pair : reference_pairs()) {
    const Proximity out = solve(pair);
    const Vector3 in_body2 = pair.pose2.rotation.transpose() * (out.point2 - pair.pose2.position);
    const Vector3 normal2 = -(pair.pose2.rotation.transpose() * out.normal);
    const double size = pair.surface1.half_axes().maxCoeff() + pair.surface2.half_axes().maxCoeff();
    const double rounding = 1e-14 * size;
    const bool on_surfaces = std::abs(gauge(pair.surface1, out.point1) - 1) <= rounding / pair.surface1.half_axes().minCoeff() &&
                             std::abs(gauge(pair.surface2, in_body2) - 1) <= rounding / pair.surface2.half_axes().minCoeff();
    const bool on_planes = std::abs(out.normal.dot(out.point1) - pair.shape1->support(out.normal)) <= rounding &&
                           std::abs(normal2.dot(in_body2) - pair.shape2->support(normal2)) <= rounding;
    const bool a_gap_apart = std::abs(out.normal.dot(out.point2 - out.point1) - out.gap) <= rounding;
    const bool unit = std::abs(out.normal.norm() - 1) <= 4e-16;
    if (!(on_surfaces && on_planes && a_gap_apart && unit)) {
      FAIL_CHECK(pair.name, " on surfaces ", on_surfaces, " on planes ", on_planes, " a gap apart ", a_gap_apart, " unit ", unit);
    }
  }
}

// s is a maximum to within the error e, so the normal n lies at e >= 1/2 dn.A dn from the true one, A = H1 + H2 + s I: hence
// |dn| <= sqrt(2 e / least eigenvalue of A). The boundary point moves by H1 dn, and |H1 dn|^2 <= |H1| dn.H1 dn, dn.H1 dn <= 2 e +
// max(-s, 0) dn^2. Both bounds take the worse of the curvatures at either end.
TEST_CASE("witness points and normals where they are determined") {
  const Settings tight{.tolerance = 1e-14};
  int compared = 0;
  std::vector<double> normal_errors, point_errors;
  for (const ReferencePair& pair : reference_pairs()) {
    if (!pair.is_unique || !pair.is_well) continue;
    const Proximity out = solve(pair, tight);
    GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    double lowest = std::numeric_limits<double>::infinity(), flattest = 0;
    for (const Vector3& n : {out.normal, Vector3(pair.normal.normalized())}) {
      GapJet jet;
      gap.evaluate(n, Order::Hessian, jet);
      const LocalModel local = LocalModel::of(gap, jet);
      lowest = std::min(lowest, Eigen2(local.model.A).low);
      flattest = std::max({flattest, Eigen2(local.A1).high, Eigen2(local.A2).high});
    }
    if (!(lowest > 0)) continue;
    ++compared;
    const double energy = 2 * (out.error + gap.rounding());
    const double turn = std::sqrt(energy / lowest) + 1e-15;
    const double shift = std::sqrt(flattest * energy * (1 + std::max(-out.gap, 0.0) / lowest)) + gap.rounding();
    const double turned = (out.normal - pair.normal).norm();
    const double shifted = std::max((out.point1 - pair.point1).norm(), (out.point2 - pair.point2).norm());
    normal_errors.push_back(turned);
    point_errors.push_back(shifted / pair.unit);
    if (!(turned <= turn)) FAIL_CHECK(pair.name, " normal off by ", turned, " allowed ", turn);
    if (!(shifted <= shift)) FAIL_CHECK(pair.name, " nominal ", pair.nominal, " points off by ", shifted, " allowed ", shift);
  }
  std::sort(normal_errors.begin(), normal_errors.end());
  std::sort(point_errors.begin(), point_errors.end());
  const std::size_t most = normal_errors.size() * 9 / 10;
  MESSAGE(compared, " compared; 90 % of the normals within ", normal_errors[most], ", of the points within ", point_errors[most]);
  CHECK(compared > 1500);
}

TEST_CASE("branch and bound, with which other tests compare, encloses the gaps of the reference pairs") {
  for (const ReferencePair& pair : some_of(reference_pairs())) {
    const double width = 1e-12 * pair.unit;
    const GapBounds bounds = bound_gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, width);
    const double rounding =
        1e-15 * (pair.pose2.position.norm() + pair.surface1.half_axes().maxCoeff() + pair.surface2.half_axes().maxCoeff());
    const bool good =
        bounds.upper - bounds.lower <= width && bounds.lower <= pair.gap + rounding && bounds.upper >= pair.gap - rounding;
    if (!good) FAIL_CHECK(pair.name, " gap ", pair.gap, " between ", bounds.lower - pair.gap, " and ", bounds.upper - pair.gap);
  }
}

TEST_CASE("a pure translation by 10 km: the answer belongs to the rounded positions, bit for bit") {
  const Vector3 far(6000, -7000, 3872.983346207417);
  for (const ReferencePair& pair : reference_pairs()) {
    const Pose one{far, pair.pose1.rotation}, two{far + pair.pose2.position, pair.pose2.rotation};
    const Pose rounded{two.position - one.position, two.rotation};  // exact: no digit is left to round away
    const Proximity out = find_proximity(*pair.shape1, one, *pair.shape2, two);
    const Proximity expected = find_proximity(*pair.shape1, {Vector3::Zero(), one.rotation}, *pair.shape2, rounded);
    const bool same = out.gap == expected.gap && out.error == expected.error && out.normal == expected.normal &&
                      out.evaluations == expected.evaluations && out.point1 == expected.point1 + far &&
                      out.point2 == expected.point2 + far;
    if (!same) FAIL_CHECK(pair.name, "\n  gap ", out.gap, " instead of ", expected.gap);
  }
}
