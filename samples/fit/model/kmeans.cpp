#include "kmeans.hpp"

#include <algorithm>
#include <limits>
#include <random>

namespace fit {
namespace {

int nearest_of(const std::vector<Eigen::Vector3d>& centres, const Eigen::Vector3d& x, double& square) {
  int nearest = 0;
  square = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < centres.size(); ++k) {
    const double candidate = (x - centres[k]).squaredNorm();
    if (candidate < square) {
      square = candidate;
      nearest = static_cast<int>(k);
    }
  }
  return nearest;
}

/// Random points as centres, each with a probability proportional to its squared distance from the previous centres.
std::vector<Eigen::Vector3d> first_centres(std::span<const Eigen::Vector3d> points, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Eigen::Vector3d> centres = {points[random() % points.size()]};
  std::vector<double> sums(points.size());
  while (static_cast<int>(centres.size()) < count) {
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      double square = 0;
      nearest_of(centres, points[i], square);
      sums[i] = sum += square;
    }
    const double chosen = sum * static_cast<double>(random() >> 11) * 0x1p-53;
    const auto found = static_cast<std::size_t>(std::ranges::upper_bound(sums, chosen) - sums.begin());
    centres.push_back(points[std::min(found, points.size() - 1)]);
  }
  return centres;
}

}  // namespace

std::vector<int> find_clusters(std::span<const Eigen::Vector3d> points, int count, std::uint64_t seed) {
  constexpr int kRounds = 30;
  std::vector<Eigen::Vector3d> centres = first_centres(points, count, seed);
  std::vector<int> cluster(points.size(), -1);
  for (int round = 0; round < kRounds; ++round) {
    bool has_changed = false;
    std::vector<Eigen::Vector3d> sums(centres.size(), Eigen::Vector3d::Zero());
    std::vector<double> counts(centres.size(), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      double square = 0;
      const int nearest = nearest_of(centres, points[i], square);
      has_changed = has_changed || nearest != cluster[i];
      cluster[i] = nearest;
      sums[static_cast<std::size_t>(nearest)] += points[i];
      counts[static_cast<std::size_t>(nearest)] += 1;
    }
    for (std::size_t k = 0; k < centres.size(); ++k) {
      if (counts[k] > 0) centres[k] = sums[k] / counts[k];
    }
    if (!has_changed) break;
  }
  return cluster;
}

}  // namespace fit
