#include "cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "point_tree.hpp"

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
    const double chosen = sum * uniform(random);
    const auto found = static_cast<std::size_t>(std::ranges::upper_bound(sums, chosen) - sums.begin());
    centres.push_back(points[std::min(found, points.size() - 1)]);
  }
  return centres;
}

}  // namespace

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

double ranked(std::vector<double> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  return ranked(std::move(values), middle);
}

Extent extent_of(std::span<const Eigen::Vector3d> points) {
  Extent extent;
  const auto count = static_cast<double>(points.size());
  for (const Eigen::Vector3d& x : points) extent.centre += x / count;
  double square = 0;
  for (const Eigen::Vector3d& x : points) square += (x - extent.centre).squaredNorm() / count;
  extent.size = std::sqrt(square);
  return extent;
}

double radius_of(std::span<const Eigen::Vector3d> points) {
  const Eigen::Vector3d centre = extent_of(points).centre;
  std::vector<double> radii(points.size());
  std::ranges::transform(points, radii.begin(), [&](const Eigen::Vector3d& x) { return (x - centre).norm(); });
  const auto rank = static_cast<std::size_t>(0.99 * static_cast<double>(radii.size() - 1));
  return ranked(std::move(radii), rank);
}

std::vector<std::size_t> cut_off(std::span<const Eigen::Vector3d> points, std::size_t most) {
  constexpr double kShell = 2;  // outer over inner radius
  const bool is_finite = std::ranges::all_of(points, [](const Eigen::Vector3d& x) { return x.allFinite(); });
  if (!is_finite || points.size() < 2) return {};
  Eigen::Vector3d middle;
  std::vector<double> values(points.size());
  for (int i = 0; i < 3; ++i) {
    std::ranges::transform(points, values.begin(), [&](const Eigen::Vector3d& x) { return x[i]; });
    middle[i] = median(values);
  }
  const auto radius_at = [&](std::size_t i) { return (points[i] - middle).norm(); };
  for (std::size_t i = 0; i < points.size(); ++i) values[i] = radius_at(i);
  std::ranges::sort(values);
  const auto first = std::ranges::adjacent_find(values.end() - static_cast<std::ptrdiff_t>(std::min(most, values.size() - 1)) - 1,
                                                values.end(), [](double inner, double outer) { return outer > kShell * inner; });
  std::vector<std::size_t> beyond;
  for (std::size_t i = 0; first != values.end() && i < points.size(); ++i) {
    if (radius_at(i) > *first) beyond.push_back(i);
  }
  return beyond;
}

std::vector<std::size_t> isolated(std::span<const Eigen::Vector3d> points) {
  constexpr std::size_t kNeighbours = 8;
  constexpr double kFarther = 3;  // than the median
  const bool is_finite = std::ranges::all_of(points, [](const Eigen::Vector3d& x) { return x.allFinite(); });
  if (!is_finite || points.size() <= kNeighbours) return {};
  const PointTree tree({points.begin(), points.end()});
  std::vector<double> distances;
  for (const Eigen::Vector3d& x : points) {
    double sum = 0;
    for (const std::uint32_t i : tree.nearest(x, kNeighbours + 1)) sum += (points[i] - x).norm();
    distances.push_back(sum / static_cast<double>(kNeighbours));
  }
  const double middle = median(distances);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (distances[i] > kFarther * middle) found.push_back(i);
  }
  return !(middle > 0) || 4 * found.size() > points.size() ? std::vector<std::size_t>() : found;
}

std::vector<Eigen::Vector3d> spread_directions(int count) {
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = 2 * std::numbers::pi * i / std::numbers::phi;
    const double radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

Cloud normalized(const Cloud& cloud, const Extent& extent) {
  Cloud result = cloud;
  for (Eigen::Vector3d& x : result.points) x = (x - extent.centre) / extent.size;
  return result;
}

Cloud selected(const Cloud& cloud, std::span<const std::size_t> indices) {
  Cloud result;
  for (const std::size_t i : indices) {
    result.points.push_back(cloud.points[i]);
    if (!cloud.normals.empty()) result.normals.push_back(cloud.normals[i]);
  }
  return result;
}

std::vector<std::size_t> others_than(std::span<const std::size_t> indices, std::size_t count) {
  std::vector<bool> is_other(count, true);
  for (const std::size_t i : indices) is_other[i] = false;
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_other[i]) others.push_back(i);
  }
  return others;
}

Cloud without(const Cloud& cloud, std::span<const std::size_t> indices) {
  return indices.empty() ? cloud : selected(cloud, others_than(indices, cloud.points.size()));
}

Cloud thinned(const Cloud& cloud, std::size_t count) {
  if (cloud.points.size() <= count) return cloud;
  std::vector<std::size_t> order(cloud.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(1);
  // The distributions of <random> differ between standard libraries. The remainder does not; its bias is 1e-13.
  for (std::size_t i = 0; i < count; ++i) std::swap(order[i], order[i + random() % (order.size() - i)]);
  order.resize(count);
  return selected(cloud, order);
}

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
