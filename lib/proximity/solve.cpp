#include "supernormal/proximity/solve.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/usable_pose.hpp"
#include "base/validation.hpp"
#include "proximity/gap/usable_settings.hpp"
#include "proximity/lanes/lane_query.hpp"
#include "proximity/local/first_guess.hpp"
#include "proximity/search/answer.hpp"
#include "proximity/search/solvers.hpp"

namespace supernormal {
namespace {

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

// The ascent only knows the faces and edges of body 2. It finds those on body 1 by cuts and, if both bodies have some, at its end
// (MeetingPoint). So the body with faces and edges must be body 2.
Proximity find_with_bodies_swapped(const ProximityQuery& pair, const Settings& settings) {
  Vector3 normal;
  const bool is_warm = pair.first_normal != nullptr;
  if (is_warm) normal = -(pair.pose2->rotation.transpose() * (pair.pose1->rotation * *pair.first_normal));
  Proximity out = find_proximity({pair.shape2, pair.pose2, pair.shape1, pair.pose1, is_warm ? &normal : nullptr, true}, settings);
  out.normal = -out.normal;
  out.point1.swap(out.point2);
  return out;
}

/// The query without a first normal that is no unit vector.
ProximityQuery with_usable_normal(ProximityQuery query) {
  if (query.first_normal != nullptr && !is_usable(*query.first_normal)) query.first_normal = nullptr;
  return query;
}

/// Whether a ball rolls in the shape that is as large as the shape.
bool is_ball(const Shape& shape) { return shape.rolling_radius() == shape.bounding_radius(); }

/// The answer where neither the poses nor the shapes are at fault, or InvalidInput.
Proximity find_alone(const ProximityQuery& pair, const Settings& settings) {
  GapFunction gap(*pair.shape1, *pair.pose1, *pair.shape2, *pair.pose2);
  if (!gap.is_finite()) return {};
  if (is_ball(*pair.shape1) && is_ball(*pair.shape2)) {
    return find_between_balls(pair, pair.shape1->bounding_radius(), pair.shape2->bounding_radius(), settings);
  }
  const Vector3* const first = pair.first_normal;
  const Proximity out = first != nullptr ? solve(gap, settings, first->normalized(), WantedMaximum::Tracked)
                                         : solve(gap, settings, first_guess(gap), WantedMaximum::Highest);
  if (out.status == Status::InvalidInput || !std::isfinite(out.gap) || !all_finite(out.normal) || !out.point1.allFinite() ||
      !out.point2.allFinite())
    return {};
  return in_world(out, *pair.pose1);
}

}  // namespace

Proximity find_proximity(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Settings& settings,
                         const Vector3* first_normal) {
  return find_proximity({&shape1, &pose1, &shape2, &pose2, first_normal}, settings);
}

Proximity find_proximity(const ProximityQuery& query, const Settings& settings) {
  require_in_range(settings);
  if (!has_usable_poses(query)) return {};
  const ProximityQuery pair = with_usable_normal(query);
  const Shape &shape1 = *pair.shape1, &shape2 = *pair.shape2;
  if (is_for_lanes(shape1, shape2, settings)) return find_in_one_lane(pair, settings);
  if (shape1.traits().has_nonsmooth_points && !shape2.traits().has_nonsmooth_points) {
    return find_with_bodies_swapped(pair, settings);
  }
  return find_alone(pair, settings);
}

void find_proximities(std::span<const ProximityQuery> queries, const Settings& settings, std::span<Proximity> results) {
  find_in_lanes(queries, settings, results, {});
}

void find_in_lanes(std::span<const ProximityQuery> queries, const Settings& settings, std::span<Proximity> results,
                   std::span<ContactCurvature> curvatures) {
  require_in_range(settings);
  require_one_for_each("results", results.size(), queries.size());
  const LaneKernels& kernels = lane_kernels();
  LaneBatch in_lanes(settings, *kernels.kernels[kernels.count - 1], results, curvatures);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const ProximityQuery& query = queries[k];
    if (has_usable_poses(query) && is_for_lanes(*query.shape1, *query.shape2, settings)) {
      in_lanes.add(with_usable_normal(query), k);
    } else {
      results[k] = find_proximity(query, settings);
      if (!curvatures.empty()) curvatures[k] = {kUnknownCurvature, kUnknownCurvature};
    }
  }
  in_lanes.solve_rest();
}

}  // namespace supernormal
