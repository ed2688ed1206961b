#include "cloud.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace fit {

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
  const auto at = radii.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(radii.size() - 1));
  std::nth_element(radii.begin(), at, radii.end());
  return *at;
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

Cloud thinned(const Cloud& cloud, std::size_t count) {
  if (cloud.points.size() <= count) return cloud;
  std::vector<std::size_t> order(cloud.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(1);
  // The distributions of <random> differ between libraries; the remainder does not, and its bias is 1e-13.
  for (std::size_t i = 0; i < count; ++i) std::swap(order[i], order[i + random() % (order.size() - i)]);
  order.resize(count);
  return selected(cloud, order);
}

}  // namespace fit
