// Many linear functions of a direction, and which of them is lowest.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// d_k.n, kept component by component so that a few are computed at a time.
class LinearBounds {
 public:
  using Index = std::size_t;

  void clear() {
    for (std::vector<double>& row : rows_) row.clear();
  }
  void add(const Vector3& d) {
    for (std::size_t i = 0; i < 3; ++i) rows_[i].push_back(d[static_cast<int>(i)]);
  }
  Index size() const { return rows_[0].size(); }

  double at(Index k, const Vector3& n) const { return rows_[0][k] * n.x() + rows_[1][k] * n.y() + rows_[2][k] * n.z(); }

  /// The lowest of those from `first` on, of which there must be one.
  Index lowest(const Vector3& n, Index first = 0) const {
    const auto row = [&](std::size_t i) {
      return Eigen::Map<const Eigen::ArrayXd>(rows_[i].data() + first, static_cast<Eigen::Index>(size() - first));
    };
    values_.resize(size() - first);
    Eigen::Map<Eigen::ArrayXd> values(values_.data(), static_cast<Eigen::Index>(values_.size()));
    values = row(0) * n.x() + row(1) * n.y() + row(2) * n.z();
    const double least = values.minCoeff();
    Index k = 0;
    while (k + 1 < values_.size() && values_[k] != least) ++k;
    return first + k;
  }

 private:
  std::array<std::vector<double>, 3> rows_;
  mutable std::vector<double> values_;
};

}  // namespace supernormal
