// Where on a flat triangle the least of a few linear functions is largest.
#pragma once

#include <array>
#include <limits>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// max over w >= 0, sum(w) = 1 of min over k of cut_k.w: a linear program in two unknowns, w being barycentric coordinates and
/// cut_k the values of one function at the three corners. One cut after the other (Seidel 1991): where a new one is below the
/// maximum so far, the new maximum lies on it, among the points where no other is lower. Of these, likewise one after the other,
/// the maximum so far is the best of all or lies on the line where the next cut is as low. Cuts that differ by rounding count as
/// one.
class BarycentricLp {
 public:
  static constexpr std::size_t kMaxCuts = 6;

  /// Returns its place: if there is no room, that of the cut that is highest at the maximum, and so does not hold it.
  std::size_t add(const Vector3& cut);

  /// The maximum, and where; infinite, and nowhere, before the first cut. Rounding apart, it never rises.
  double value() const { return value_; }
  Vector3 weights() const { return {1 - (place_.x + place_.y), place_.x, place_.y}; }
  std::size_t size() const { return count_; }

 private:
  /// The weights of the second and the third corner.
  struct Place {
    double x = 0, y = 0;
  };
  /// constant + x_slope x + y_slope y, each known to `rounding`.
  struct Linear {
    double constant, x_slope, y_slope, rounding;
    double at(const Place& p) const { return constant + x_slope * p.x + y_slope * p.y; }
    Linear operator-(const Linear& other) const {
      return {constant - other.constant, x_slope - other.x_slope, y_slope - other.y_slope, rounding + other.rounding};
    }
  };

  bool maximize(const Linear& lowest, Place& top) const;
  bool maximize_on_line(const Linear& line, const Linear& lowest, std::size_t earlier, Place& top) const;

  std::array<Linear, kMaxCuts> cuts_;
  std::size_t count_ = 0;
  double value_ = std::numeric_limits<double>::infinity();
  Place place_;
};

}  // namespace supernormal
