// Clusters of points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace fit {

/// The number of the cluster of each point: Lloyd's k-means from the random starts of k-means++ (Arthur and Vassilvitskii 2007).
std::vector<int> find_clusters(std::span<const Eigen::Vector3d> points, int count, std::uint64_t seed);

}  // namespace fit
