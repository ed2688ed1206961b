#include "shapes/lanes/lane_body_of.hpp"

#include "shapes/lanes/superellipsoid_jet.hpp"

namespace supernormal {
LaneBody make_lane_body(const Shape& shape, const Vector3& half_axes, double delta, double epsilon) {
  const double p_minus_1 = 1 / (delta - 1), q_minus_1 = 1 / (epsilon - 1);
  return {.half = {half_axes.x(), half_axes.y(), half_axes.z()},
          .p_minus_1 = p_minus_1,
          .inverse_p = (delta - 1) / delta,
          .q_minus_1 = q_minus_1,
          .inverse_q = (epsilon - 1) / epsilon,
          .flat_p = flat_power(p_minus_1),
          .flat_q = flat_power(q_minus_1),
          .delta_minus_1 = delta - 1,
          .inverse_delta = 1 / delta,
          .epsilon_minus_1 = epsilon - 1,
          .inverse_epsilon = 1 / epsilon,
          .rolling_radius = shape.rolling_radius(),
          .bounding_radius = shape.bounding_radius(),
          .curvature_radius = shape.min_curvature_radius_estimate(),
          .size = half_axes.norm(),
          .is_ellipsoid = delta == 2 && epsilon == 2};
}

}  // namespace supernormal
