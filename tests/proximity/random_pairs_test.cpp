// Random pairs beyond the reference file: what must hold whatever the answer is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>

#include "covers.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"
#include "support/superellipsoid_classes.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

const int kPairsPerClass = draws(4000);
constexpr double kMissedGap = 1e-6;  // of the smallest half-axis
constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

double pair_unit(const Shape& shape1, const Shape& shape2) {
  return std::min(shape1.half_extents().minCoeff(), shape2.half_extents().minCoeff());
}

/// Near touching, apart or overlapping by up to about half of the size.
Pose draw_pose(const Superellipsoid& shape1, const Superellipsoid& shape2, Draw& draw) {
  const Vector3 n = draw.direction();
  const Matrix3 rotation = draw.rotation();
  return {draw.log_uniform(0.5, std::sqrt(2)) * (shape1.support(n) + shape2.support(-(rotation.transpose() * n))) * n, rotation};
}

}  // namespace

TEST_CASE("random pairs: finite, consistent, quiet, proved where they must be, and within the interval") {
  unsigned seed = 100;
  for (const SuperellipsoidClass& kind : kSuperellipsoidClasses) {
    Draw draw(++seed);
    int higher = 0, overlapping = 0, unconverged = 0;
    for (int k = 0; k < kPairsPerClass; ++k) {
      const Superellipsoid surface1 = draw_superellipsoid(kind, draw), surface2 = draw_superellipsoid(kind, draw);
      const auto shape1 = make_shape(surface1), shape2 = make_shape(surface2);
      const Pose pose2 = draw_pose(surface1, surface2, draw);
      const std::string name = std::string(kind.name) + " " + std::to_string(k);

      std::feclearexcept(kTrapped);
      const Proximity out = find_proximity(*shape1, {}, *shape2, pose2);
      if (std::fetestexcept(kTrapped)) FAIL_CHECK(name, " raised ", std::fetestexcept(kTrapped));
      const bool finite = std::isfinite(out.gap) && std::isfinite(out.error) && out.point1.allFinite() && out.point2.allFinite() &&
                          out.contact.allFinite();
      if (!finite) FAIL_CHECK(name, " is not finite");
      if (!(std::abs(out.normal.norm() - 1) <= 4e-16)) FAIL_CHECK(name, " normal of length ", out.normal.norm());
      if (out.status != Status::Converged) {
        ++unconverged;
        MESSAGE(name, " status ", static_cast<int>(out.status), " gap ", out.gap, " error ", out.error);
      }

      GapFunction gap(*shape1, {}, *shape2, pose2);
      GapJet jet;
      gap.evaluate(out.normal, Order::Point, jet);
      if (!(std::abs(jet.s - out.gap) <= gap.rounding())) FAIL_CHECK(name, " gap ", out.gap, " but s ", jet.s);
      overlapping += out.gap < 0;

      // Where the maximum must be proved it is; elsewhere the interval holds what a climb from here finds.
      if (must_be_proved(gap, {}, out.gap) && !(out.is_global && out.status == Status::Converged)) {
        FAIL_CHECK(name, " gap ", out.gap, " status ", static_cast<int>(out.status), " is not proved");
      }
      Settings tight;
      tight.tolerance = 1e-14;
      const Proximity again = find_proximity(*shape1, {}, *shape2, pose2, tight, &out.normal);
      const double rise = again.gap - out.gap;
      if (rise < -(gap.rounding() + again.error)) FAIL_CHECK(name, " fell by ", -rise);
      if (!(rise <= out.global_error + gap.rounding())) FAIL_CHECK(name, " rose by ", rise, " of ", out.global_error, " at most");
      higher += rise > kMissedGap * pair_unit(*shape1, *shape2);
    }
    MESSAGE(std::string(kind.name), ": ", overlapping, " overlapping, ", higher, " found a higher maximum in a second solve");
    CHECK(overlapping > kPairsPerClass / 5);
    CHECK(overlapping < kPairsPerClass);
    CHECK(unconverged == 0);
  }
}
