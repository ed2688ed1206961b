#include "cloud.hpp"

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
