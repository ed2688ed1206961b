#include "supernormal/proximity/solve.hpp"

#include <cmath>

#include "proximity/local/first_guess.hpp"
#include "proximity/solvers.hpp"
#include "proximity/usable_pose.hpp"
#include "shapes/validation.hpp"

namespace supernormal {
namespace {

constexpr double kMinTolerance = 1e-15;
constexpr double kMaxTolerance = 1;
constexpr double kMaxEvaluations = 1e6;

void check(const Settings& settings) {
  require_in("tolerance", settings.tolerance, kMinTolerance, kMaxTolerance);
  require_in("max_evaluations", settings.max_evaluations, 1, kMaxEvaluations);
}

Proximity solve(GapFunction& gap, const Settings& settings, const Vector3& start, WantedMaximum wanted) {
  if (gap.traits2().has_nonsmooth_points) return solve_hybrid(gap, settings, start, wanted);
  switch (settings.solver) {
    case Solver::Newton:
      if (gap.has_hessian()) return solve_newton(gap, settings, start);
      break;
    case Solver::FixedPoint:
      return solve_fixed_point(gap, settings, start);
    case Solver::Hybrid:
      break;
  }
  return solve_hybrid(gap, settings, start, wanted);
}

// The entries are tested first, because squares and sums of numbers out of range would raise floating-point exceptions.
bool is_usable(const Vector3& normal) { return all_within(normal, 2) && std::abs(normal.squaredNorm() - 1) < 1e-6; }

// The ascent only knows the faces and edges of body 2. It finds those on body 1 by cuts and, if both bodies have some, at its end
// (MeetingPoint). So the body with faces and edges must be body 2.
Proximity find_with_bodies_swapped(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                   const Settings& settings, const Vector3* first_normal) {
  const bool is_warm = first_normal != nullptr && is_usable(*first_normal);
  Vector3 normal;
  if (is_warm) normal = -(pose2.rotation.transpose() * (pose1.rotation * *first_normal));
  Proximity out = find_proximity(shape2, pose2, shape1, pose1, settings, is_warm ? &normal : nullptr);
  out.normal = -out.normal;
  out.point1.swap(out.point2);
  return out;
}

}  // namespace

Proximity find_proximity(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Settings& settings,
                         const Vector3* first_normal) {
  check(settings);
  if (!is_usable(pose1) || !is_usable(pose2)) return {};
  if (shape1.traits().has_nonsmooth_points && !shape2.traits().has_nonsmooth_points) {
    return find_with_bodies_swapped(shape1, pose1, shape2, pose2, settings, first_normal);
  }
  GapFunction gap(shape1, pose1, shape2, pose2);
  if (!gap.is_finite()) return {};
  const bool is_warm = first_normal != nullptr && is_usable(*first_normal);
  Proximity out = is_warm ? solve(gap, settings, first_normal->normalized(), WantedMaximum::Tracked)
                          : solve(gap, settings, first_guess(gap), WantedMaximum::Highest);
  if (out.status == Status::InvalidInput || !std::isfinite(out.gap) || !all_finite(out.normal) || !out.point1.allFinite() ||
      !out.point2.allFinite())
    return {};
  out.normal = (pose1.rotation * out.normal).normalized();
  out.point1 = pose1.rotation * out.point1 + pose1.position;
  out.point2 = pose1.rotation * out.point2 + pose1.position;
  out.contact = pose1.rotation * out.contact + pose1.position;
  return out;
}

}  // namespace supernormal
