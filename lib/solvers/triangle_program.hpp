// Where on a flat triangle the least of a few linear functions is largest.
#pragma once

#include <array>
#include <limits>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// max over w >= 0, sum(w) = 1 of min over k of cut_k.w: a linear program in two unknowns, w being barycentric coordinates and
/// cut_k the values of one function at the three corners. One cut after the other: where a new one is below the maximum so far, the
/// new maximum lies on it (Seidel 1991), in the polygon where it is the lowest.
class TriangleProgram {
 public:
  static constexpr std::size_t kMaxCuts = 6;

  /// Returns its place: if there is no room, that of the cut that is highest at the maximum, and so does not hold it.
  std::size_t add(const Vector3& cut);

  /// The maximum, and where; infinite, and nowhere, before the first cut. Rounding apart, it never rises.
  double value() const { return value_; }
  const Vector3& weights() const { return weights_; }
  std::size_t size() const { return count_; }

 private:
  std::array<Vector3, kMaxCuts> cuts_;
  std::size_t count_ = 0;
  double value_ = std::numeric_limits<double>::infinity();
  Vector3 weights_ = Vector3::Zero();
};

}  // namespace supernormal
