// The numbers of a superellipsoid that a query of many pairs reads.
#pragma once

namespace supernormal {

/// An ellipsoid or superellipsoid as plain numbers. Queries evaluate such bodies in vector lanes (lib/proximity/lanes). The
/// exponents are delta and epsilon; the dual exponents are p = delta/(delta - 1) and q = epsilon/(epsilon - 1)
/// (superellipsoid.hpp).
struct LaneBody {
  double half[3];            ///< m; half-axes
  double p_minus_1;          ///< without cancellation
  double inverse_p;          ///< 1/p
  double q_minus_1;          ///< without cancellation
  double inverse_q;          ///< 1/q
  double flat_p;             ///< k^(p-2) at the ratio k below which the second derivative stays constant (power_norm.cpp)
  double flat_q;             ///< k^(q-2) at this ratio
  double delta_minus_1;      ///< delta - 1
  double inverse_delta;      ///< 1/delta
  double epsilon_minus_1;    ///< epsilon - 1
  double inverse_epsilon;    ///< 1/epsilon
  double rolling_radius;     ///< m; Shape::rolling_radius
  double bounding_radius;    ///< m; Shape::bounding_radius
  double curvature_radius;   ///< m; Shape::min_curvature_radius_estimate
  double size;               ///< m; the length of the vector of the half-axes
  bool is_ellipsoid = true;  ///< whether both exponents are 2: the norms take no powers
};

}  // namespace supernormal
