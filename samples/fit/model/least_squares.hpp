// The body with the least squared distances to some points, by Ceres.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "body.hpp"
#include "distance.hpp"

namespace fit {

struct LeastSquaresSettings {
  /// Distances beyond it count by their first power (Huber).
  double loss_width = std::numeric_limits<double>::infinity();
  /// No half-axis becomes longer: data of one side only do not bound the body.
  double largest_half_axis = std::numeric_limits<double>::infinity();
  int max_iterations = 50;
  /// The relative decrease of the cost at which it stops.
  double tolerance = 1e-12;
  double distance_tolerance = kFineTolerance;  ///< of DistanceFunction
  int threads = 1;
};

struct LeastSquaresResult {
  Body body;
  double cost = std::numeric_limits<double>::infinity();  ///< half of the sum of squares (with the loss)
};

/// Improves `start`, whose family it keeps. `offsets`, empty or one for each point, are what the distances should be instead of 0.
/// All lengths are meant for data of size 1.
LeastSquaresResult minimize_distances(const Body& start, std::span<const Vector3> points, std::span<const double> offsets,
                                      const LeastSquaresSettings& settings);

}  // namespace fit
