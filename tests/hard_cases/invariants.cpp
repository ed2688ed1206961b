#include "invariants.hpp"

#include <cfenv>
#include <cmath>
#include <limits>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::samples {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kExceptions = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

GapFunction gap_of(const HardCase& one) { return {*one.shape1, one.pose1, *one.shape2, one.pose2}; }

/// Whether `point` (world frame) lies on the boundary of the shape where the outward normal is `normal`.
class OnSurface {
 public:
  OnSurface(const Shape& shape, const Pose& pose, double rounding) : shape_(shape), pose_(pose), rounding_(rounding) {}

  void check(const char* name, const Vector3& point, const Vector3& normal, Violations& out) const {
    const Vector3 x = pose_.rotation.transpose() * (point - pose_.position);
    const Vector3 n = (pose_.rotation.transpose() * normal).normalized();
    const double below = shape_.support(n) - n.dot(x);
    if (!(below <= rounding_)) out.push_back(name + std::string(" is ") + exact_text(below) + " m below its tangent plane");
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 side = Vector3::Unit(axis) * std::copysign(1, x[axis]);
      check_inside(name, x, side, out);
      check_inside(name, x, (n + side).normalized(), out);
    }
  }

 private:
  void check_inside(const char* name, const Vector3& x, const Vector3& direction, Violations& out) const {
    const double above = direction.dot(x) - shape_.support(direction);
    if (!(above <= rounding_)) {
      out.push_back(name + std::string(" is ") + exact_text(above) + " m outside the body along " + exact_text(direction));
    }
  }

  const Shape& shape_;
  const Pose& pose_;
  double rounding_;
};

bool is_finite(const Proximity& answer) {
  return std::isfinite(answer.gap) && std::isfinite(answer.error) && answer.normal.allFinite() && answer.point1.allFinite() &&
         answer.point2.allFinite() && answer.contact.allFinite();
}

void check_status(const GapFunction& gap, const Settings& settings, const Proximity& answer, Violations& out) {
  const bool is_early = answer.status == Status::Apart && settings.stop_when_apart;
  const bool is_known = answer.status == Status::Converged || answer.status == Status::Stalled ||
                        answer.status == Status::EvaluationLimit || is_early;
  if (!is_known) out.push_back("status " + std::to_string(static_cast<int>(answer.status)));
  const double promised = std::max(settings.tolerance * gap.length_unit(), 5 * gap.rounding());
  if (answer.status == Status::Converged && !(answer.error <= promised * (1 + 4 * kEpsilon))) {
    out.push_back("converged with an error of " + exact_text(answer.error) + " m; the tolerance is " + exact_text(promised) + " m");
  }
  if (answer.status == Status::EvaluationLimit && answer.evaluations < settings.max_evaluations) {
    out.push_back("evaluation limit after " + std::to_string(answer.evaluations) + " evaluations");
  }
  if (!(answer.error >= 0)) out.push_back("negative error " + exact_text(answer.error));
  if (!(answer.global_error >= 0)) out.push_back("negative global error " + exact_text(answer.global_error));
  // Proved for every answer if the bodies are apart, touch, or overlap by less than the rolling radius.
  const double tolerance = std::max(settings.tolerance * gap.length_unit() - gap.rounding(), 2 * gap.rounding());
  if (!(2 * answer.gap >= -tolerance || answer.gap + gap.rolling_radius() > 0)) return;
  if (!answer.is_global) out.push_back("gap " + exact_text(answer.gap) + ", but not sure to be global");
}

}  // namespace

Proximity solve(const HardCase& one, const Settings& settings, Violations& violations) {
  std::feclearexcept(kExceptions);
  const Vector3* start = one.first_normal ? &*one.first_normal : nullptr;
  const Proximity answer = find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings, start);
  if (std::fetestexcept(FE_INVALID)) violations.emplace_back("floating-point exception: invalid operation");
  if (std::fetestexcept(FE_DIVBYZERO)) violations.emplace_back("floating-point exception: division by zero");
  if (std::fetestexcept(FE_OVERFLOW)) violations.emplace_back("floating-point exception: overflow");
  return answer;
}

double rounding_of(const HardCase& one) {
  // Points are computed in body 1's frame and then moved, with a few operations on coordinates of that size. Point 2 is point 1
  // plus the gradient of s, each with the rounding of a sum of the terms of s. The value that it is compared with has that rounding
  // once more.
  const double coordinates = one.pose1.position.norm() + one.pose2.position.norm();
  return 4 * gap_of(one).rounding() + 4 * kEpsilon * coordinates;
}

double error_of(const HardCase& one, const Settings& settings, const Proximity& answer) {
  return std::max(answer.error, settings.tolerance * gap_of(one).length_unit());
}

double ceiling_of(const HardCase& one, const Settings& settings, const Proximity& answer) {
  return answer.gap + (answer.is_global ? error_of(one, settings, answer) : answer.global_error);
}

Violations check_answer(const HardCase& one, const Settings& settings, const Proximity& answer) {
  Violations out;
  if (answer.status == Status::InvalidInput || !is_finite(answer)) return {"no answer, or one that is not finite"};
  GapFunction gap = gap_of(one);
  check_status(gap, settings, answer, out);
  const double length = answer.normal.norm();
  if (!(std::abs(length - 1) <= 4 * kEpsilon)) out.push_back("normal of length " + exact_text(length));
  const double rounding = rounding_of(one);
  GapJet jet;
  gap.evaluate((one.pose1.rotation.transpose() * answer.normal).normalized(), Order::Value, jet);
  if (!(std::abs(jet.s - answer.gap) <= rounding))
    out.push_back("gap " + exact_text(answer.gap) + ", but its normal has " + exact_text(jet.s));
  OnSurface(*one.shape1, one.pose1, rounding).check("point 1", answer.point1, answer.normal, out);
  OnSurface(*one.shape2, one.pose2, rounding).check("point 2", answer.point2, -answer.normal, out);
  const double height1 = answer.normal.dot(answer.point1 - one.pose1.position);
  const double height2 = answer.normal.dot(answer.point2 - one.pose1.position);
  const double contact = answer.normal.dot(answer.contact - one.pose1.position);
  if (!(std::abs(height2 - height1 - answer.gap) <= rounding)) {
    out.push_back("gap " + exact_text(answer.gap) + ", but the points are " + exact_text(height2 - height1) +
                  " m apart along the normal");
  }
  // In an overlap it is in both bodies up to the tolerance of the query, and so between the tangent planes.
  const double near = answer.gap < 0 ? std::max(1e-6, settings.tolerance) * gap.length_unit() : 0;
  if (!(contact >= std::min(height1, height2) - near - rounding && contact <= std::max(height1, height2) + near + rounding)) {
    out.push_back("the contact point is not between the witness points along the normal");
  }
  // The distance of the contact point from the witness points is at most their distance plus the length of the smaller body.
  const double reach = (answer.point2 - answer.point1).norm() +
                       2 * std::min(one.shape1->half_extents().norm(), one.shape2->half_extents().norm()) + rounding;
  const double off = std::max((answer.contact - answer.point1).norm(), (answer.contact - answer.point2).norm());
  if (!(off <= reach)) out.push_back("the contact point is " + exact_text(off) + " m from the witness points");
  return out;
}

Violations check(const HardCase& one, const Settings& settings) {
  Violations out;
  const Proximity answer = solve(one, settings, out);
  for (const auto& some :
       {check_answer(one, settings, answer), check_maximum(one, settings, answer), check_invariance(one, settings, answer)}) {
    out.insert(out.end(), some.begin(), some.end());
  }
  return out;
}

}  // namespace supernormal::samples
