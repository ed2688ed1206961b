// Fits a union of a few bodies to data.
#pragma once

#include <functional>
#include <vector>

#include "fit_body.hpp"

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
/// so a box is one body. Throws like fit_body(), and std::invalid_argument when largest_count is out of range. Calls `progress`
/// with the number of bodies to fit next, and the largest number.
using Progress = std::function<void(int count, int largest_count)>;
std::vector<FittedBody> fit_union(const Cloud& cloud, int largest_count, const FitSettings& settings = {},
                                  const Progress& progress = {});

}  // namespace fit
