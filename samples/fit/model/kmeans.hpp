// Clusters points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace fit {

/// The cluster index of each point: Lloyd's k-means with k-means++ starts (Arthur and Vassilvitskii 2007).
std::vector<int> find_clusters(std::span<const Eigen::Vector3d> points, int count, std::uint64_t seed);

}  // namespace fit
