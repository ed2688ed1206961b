// Least squares of point distances from a body, with Ceres.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "body.hpp"
#include "distance.hpp"
#include "empty_space.hpp"

namespace fit {

/// The volume of the data as one more residual: the mean distance of two surfaces of this area that enclose these volumes.
struct VolumeTarget {
  double volume = 0;
  double area = 1;
};

/// The weight of the volume, without unit: a mean distance counts as much as distances ten times as large.
constexpr double kVolumeWeight = 100;

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
  EmptySpace empty;                    ///< adds penalty_of()
  std::optional<VolumeTarget> volume;  ///< adds the square of the mean distance, times kVolumeWeight
  ShapeLimits limits;
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
