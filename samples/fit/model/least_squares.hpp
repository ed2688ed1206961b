// Least squares of point distances from a body, with Ceres.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "body.hpp"
#include "distance.hpp"

namespace fit {

struct LeastSquaresSettings {
  /// Distances beyond this width count linearly (Huber).
  double loss_width = std::numeric_limits<double>::infinity();
  /// Limit of the half-axes: one-sided data do not bound the body.
  double largest_half_axis = std::numeric_limits<double>::infinity();
  int max_iterations = 50;
  /// The relative decrease of the cost at which the solver stops.
  double tolerance = 1e-12;
  double distance_tolerance = kFineTolerance;  ///< passed to DistanceFunction
  int threads = 1;
};

struct LeastSquaresResult {
  Body body;
  double cost = std::numeric_limits<double>::infinity();  ///< half of the sum of squares (with the loss)
};

/// Improves `start` within its family. `offsets` are the target distances: empty (all 0) or one for each point. Lengths are for
/// data of size 1.
LeastSquaresResult minimize_distances(const Body& start, std::span<const Vector3> points, std::span<const double> offsets,
                                      const LeastSquaresSettings& settings);

}  // namespace fit
