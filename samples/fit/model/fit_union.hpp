// Fits a union of a few bodies to data.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "fit_body.hpp"
#include "fit_error.hpp"

namespace fit {

/// Fits at most `largest_count` bodies (in [1, 16]), as many as the data justify. Alternates: every point belongs to one body, and
/// every body is fitted to its points. The distance of a point from a union is its smallest distance from a body. So a body also
/// yields to points of another surface that it covers. When no point changes its owner, the alternation is at a stationary point of
/// the joint problem. The joint Jacobian consists of the Jacobians of the bodies, so their covariances are also valid for the
/// union.
///
/// The starts are ellipsoids from k-means clusterings, and the best union with one body less: with one more for a cluster of points
/// outside it, or with two for the points of a body that fits badly. A further body is accepted if it lowers the Bayesian
/// information criterion, and the root mean square by a twentieth. Distances below the error of the sharpest edge count as equal,
/// so a box is one body.
/// If the union is not within the limits of a good fit, the next best union of the search descends, too, up to the fourth; the
/// nearest to the limits is the result. Throws like fit_body(), and std::invalid_argument when largest_count is out of range. Calls
/// `progress` with the number of bodies to fit next, and the largest number.
using Progress = std::function<void(int count, int largest_count)>;
std::vector<FittedBody> fit_union(const Cloud& cloud, int largest_count, const FitSettings& settings = {},
                                  const Progress& progress = {});

/// How far a union is from the limits of a good fit, for the root mean square and the reach. A smaller one is nearer: within the
/// limits, or else with the smaller root of the sum of squares.
struct Excess {
  double rms = 0, reach = 0;  ///< over the limits

  Excess() = default;
  /// `most_reach`: the data do not show a reach smaller than the margin of their empty space.
  Excess(const FitError& error, double most_reach)
      : rms(error.rms / (kMostDistance * error.radius)), reach(error.reach / most_reach) {}
  bool is_within() const { return rms <= 1 && reach <= 1; }
  bool operator<(const Excess& other) const {
    if (is_within() != other.is_within()) return is_within();
    return std::hypot(rms, reach) < std::hypot(other.rms, other.reach);
  }
};

struct Union {
  std::vector<FittedBody> bodies;
  Excess excess;  ///< 0 if the data need no bound
};

/// Descends again if a union is not within the limits. In the search, every excess costs. Here only one beyond the largest reach of
/// a good fit does, and costs a hundred times as much: least squares under a bound. A penalty alone leaves some excess. The bound
/// moves inwards by what is left, so that the weight need not grow (the method of multipliers in the form of Powell 1969). A result
/// counts if it is nearer to the limits.
Union bounded(std::vector<FittedBody> fitted, const Cloud& cloud, FitSettings settings);

}  // namespace fit
