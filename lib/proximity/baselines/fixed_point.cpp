#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/finite.hpp"
#include "proximity/search/answer.hpp"
#include "proximity/search/solvers.hpp"

namespace supernormal {
namespace {

// The remaining error is summed as a geometric series with the contraction of the iteration. The contraction is assumed to be no
// slower than this.
constexpr double kSlowestContraction = 0.95;

// Safety factor on the gain, because the next contraction may differ from the last.
constexpr double kGainSafety = 2;

// rad; two normals closer than this do not determine a radius of curvature, because their boundary points differ only by rounding.
constexpr double kSmallestAngle = 1e-9;

/// The outward normal line of one body at its boundary point, and the estimated centre of curvature on it.
class NormalLine {
 public:
  /// `support` (m) is the distance of the tangent plane from the body's origin: the first estimate of the radius of curvature.
  Vector3 centre_of_curvature(const Vector3& point, const Vector3& normal, double support) {
    if (!has_previous_) {
      radius_ = support;
    } else {
      // The new centre is the point of this line nearest to the previous line. Nearly parallel lines keep the radius.
      const Vector3 across = normal.cross(normal_);
      const double squared = across.squaredNorm();
      if (squared > kSmallestAngle * kSmallestAngle) radius_ = -across.dot((point_ - point).cross(normal_)) / squared;
    }
    has_previous_ = true;
    point_ = point;
    normal_ = normal;
    return point - radius_ * normal;
  }

 private:
  Vector3 point_ = Vector3::Zero(), normal_ = Vector3::Zero();
  double radius_ = 0;
  bool has_previous_ = false;
};

/// The answer after convergence. The search needs no derivatives, but the contact point does. So this makes one more evaluation, if
/// there are derivatives and the limit allows it.
Proximity converged_answer(GapFunction& gap, const StoppingRule& rule, GapJet& jet, double error) {
  const bool knows_contact = !gap.has_hessian() || rule.may_evaluate();
  if (knows_contact && gap.has_hessian()) gap.evaluate(jet.n, Order::Hessian, jet);
  Proximity out = answer(gap, rule, jet, error, Status::Converged);
  if (knows_contact) place_contact(gap, rule, jet, out);
  return out;
}

}  // namespace

Proximity solve_fixed_point(GapFunction& gap, const Settings& settings, const Vector3& start) {
  const StoppingRule rule(gap, settings);
  GapJet jet;
  NormalLine line1, line2;
  Vector3 n = start;
  double previous_gain = 0;
  while (true) {
    gap.evaluate(n, Order::Point, jet);
    if (rule.is_apart(jet)) return answer(gap, rule, jet, 0, Status::Apart);

    const Vector3 centre1 = line1.centre_of_curvature(jet.jet1.r, n, jet.jet1.h);
    const Vector3 centre2 = line2.centre_of_curvature(jet.jet1.r + jet.d, -n, jet.jet2.h);
    const Vector3 next = (centre2 - centre1).normalized();
    if (!all_finite(next) || next == Vector3::Zero()) return answer(gap, rule, jet, 0, Status::Diverged);

    // Slope times step bounds the gain of this step. The following steps shrink by the contraction.
    const double gain = std::abs(jet.d.dot(next - n * next.dot(n)));
    const double contraction = previous_gain > 0 ? std::min(gain / previous_gain, kSlowestContraction) : kSlowestContraction;
    const double error = kGainSafety * gain / (1 - contraction);
    if (rule.allows(error)) return converged_answer(gap, rule, jet, error);
    if (!rule.may_evaluate()) return answer(gap, rule, jet, error, Status::EvaluationLimit);
    previous_gain = gain;
    n = next;
  }
}

}  // namespace supernormal
