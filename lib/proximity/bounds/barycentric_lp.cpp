#include "proximity/bounds/barycentric_lp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal {
namespace {

// Of the largest value of a cut at a corner: the error of its values and of their differences.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

}  // namespace

std::size_t BarycentricLp::add(const Vector3& cut) {
  const Linear added{cut[0], cut[1] - cut[0], cut[2] - cut[0], kRounding * cut.cwiseAbs().maxCoeff()};
  if (count_ == 0 || added.at(place_) < value_) {
    // Rounding may leave nothing: the maximum so far is a bound still.
    Place top;
    if (maximize(added, top)) {
      place_ = top;
      value_ = std::min(value_, added.at(top));
    }
  }
  std::size_t place = count_;
  if (count_ < kMaxCuts) {
    ++count_;
  } else {
    const auto is_lower = [&](const Linear& a, const Linear& b) { return a.at(place_) < b.at(place_); };
    place = static_cast<std::size_t>(std::max_element(cuts_.begin(), cuts_.end(), is_lower) - cuts_.begin());
  }
  cuts_[place] = added;
  return place;
}

/// The maximum of `lowest` where no cut is lower; false if there is no such place.
bool BarycentricLp::maximize(const Linear& lowest, Place& top) const {
  top = {};
  double most = 0;
  if (lowest.x_slope > most) {
    most = lowest.x_slope;
    top = {1, 0};
  }
  if (lowest.y_slope > most) top = {0, 1};
  for (std::size_t k = 0; k < count_; ++k) {
    const Linear difference = cuts_[k] - lowest;
    if (difference.at(top) < -difference.rounding && !maximize_on_line(difference, lowest, k, top)) return false;
  }
  return true;
}

/// The same on the line where `line` is zero, of the cuts for the first `earlier` only.
bool BarycentricLp::maximize_on_line(const Linear& line, const Linear& lowest, std::size_t earlier, Place& top) const {
  const double squared = line.x_slope * line.x_slope + line.y_slope * line.y_slope;
  if (!(squared > 0)) return false;
  // From the point nearest to the first corner, which is about as near as the triangle.
  const Place start{-line.constant / squared * line.x_slope, -line.constant / squared * line.y_slope};
  const auto slope_along = [&](const Linear& function) {
    return function.y_slope * line.x_slope - function.x_slope * line.y_slope;
  };
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  // With no branch on the sign of the slope, which is anybody's guess. Where there is no slope but rounding the whole line is kept,
  // which leaves the maximum a bound.
  const auto keep_positive = [&](double value, double slope, double rounding) {
    if (std::abs(slope) <= rounding) return;
    const double end = -value / slope;
    from = slope > 0 ? std::max(from, end) : from;
    to = slope > 0 ? to : std::min(to, end);
  };
  const double length = std::sqrt(squared);
  keep_positive(start.x, -line.y_slope, 0);
  keep_positive(start.y, line.x_slope, 0);
  keep_positive(1 - start.x - start.y, line.y_slope - line.x_slope, 0);
  for (std::size_t k = 0; k < earlier; ++k) {
    const Linear difference = cuts_[k] - lowest;
    keep_positive(difference.at(start), slope_along(difference), difference.rounding * length);
  }
  if (!(from <= to)) return false;
  const double end = slope_along(lowest) > 0 ? to : from;
  top = {start.x - end * line.y_slope, start.y + end * line.x_slope};
  return true;
}

}  // namespace supernormal
