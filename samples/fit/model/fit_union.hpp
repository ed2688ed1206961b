// The union of a few bodies that fits data best.
#pragma once

#include <functional>
#include <vector>

#include "fit_body.hpp"

namespace fit {

/// Fits at most `largest_count` bodies (in [1, 16]), as many as the data call for, by alternation: every point belongs to one body,
/// and every body is fitted to its points. The distance of a point from a union is the smallest of its distances from the bodies,
/// so that a body also gives way to points of another's surface that it covers. When no point changes hands, the alternation is at
/// a stationary point of the joint problem, whose Jacobian consists of the bodies' own: their covariances are those of the union.
///
/// Where to start from is found with ellipsoids, from several k-means clusterings. A number of bodies is taken when its Bayesian
/// information criterion is less than that of fewer, and its root mean square less by a twentieth; distances that the sharpest edge
/// of a body leaves count alike, so that a box is one body. std::invalid_argument as fit_body, and when largest_count is out of its
/// range. `progress` is told the number of bodies that is looked for next, and the largest.
using Progress = std::function<void(int count, int largest_count)>;
std::vector<FittedBody> fit_union(const Cloud& cloud, int largest_count, const FitSettings& settings = {},
                                  const Progress& progress = {});

}  // namespace fit
