// Nearest points, with nanoflann.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

namespace fit {

/// A search tree of points.
class PointTree {
 public:
  explicit PointTree(std::vector<Eigen::Vector3d> points) : points_{std::move(points)}, tree_(3, points_) {}
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// The indices of the `count` points nearest to x, nearest first; all points if there are fewer.
  std::vector<std::uint32_t> nearest(const Eigen::Vector3d& x, std::size_t count) const {
    std::vector<std::uint32_t> indices(count);
    std::vector<double> squares(count);
    indices.resize(tree_.knnSearch(x.data(), count, indices.data(), squares.data()));
    return indices;
  }

  /// The distance of x from the nearest point.
  double distance(const Eigen::Vector3d& x) const { return (points_.points[nearest(x, 1).front()] - x).norm(); }

  const std::vector<Eigen::Vector3d>& points() const { return points_.points; }

 private:
  /// The interface that nanoflann expects of points.
  struct Adaptor {
    std::vector<Eigen::Vector3d> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t k) const { return points[i][static_cast<Eigen::Index>(k)]; }
    bool kdtree_get_bbox(auto& /*box*/) const { return false; }
  };

  Adaptor points_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Adaptor>, Adaptor, 3> tree_;
};

}  // namespace fit
