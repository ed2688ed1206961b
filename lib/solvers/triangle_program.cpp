#include "solvers/triangle_program.hpp"

#include <algorithm>

#include "solvers/convex_polygon.hpp"

namespace supernormal {
namespace {

/// A part of the triangle, in barycentric coordinates: every cut that clips it makes at most one corner more.
using Part = ConvexPolygon<Vector3, 3 + TriangleProgram::kMaxCuts>;

Part whole_triangle() {
  Part part;
  for (int v = 0; v < 3; ++v) part.add(Vector3::Unit(v));
  return part;
}

}  // namespace

std::size_t TriangleProgram::add(const Vector3& cut) {
  if (count_ == 0 || cut.dot(weights_) < value_) {
    Part lowest = whole_triangle();
    for (std::size_t k = 0; k < count_; ++k) {
      const Vector3 difference = cuts_[k] - cut;
      lowest.clip([&](const Vector3& weights) { return difference.dot(weights); });
    }
    const Vector3* const top =
        std::max_element(lowest.begin(), lowest.end(), [&](const Vector3& a, const Vector3& b) { return cut.dot(a) < cut.dot(b); });
    // Rounding may leave nothing: the maximum so far is a bound still.
    if (top != lowest.end()) {
      weights_ = *top;
      value_ = std::min(value_, cut.dot(weights_));
    }
  }
  std::size_t place = count_;
  if (count_ < kMaxCuts) {
    ++count_;
  } else {
    const auto is_lower = [&](const Vector3& a, const Vector3& b) { return a.dot(weights_) < b.dot(weights_); };
    place = static_cast<std::size_t>(std::max_element(cuts_.begin(), cuts_.end(), is_lower) - cuts_.begin());
  }
  cuts_[place] = cut;
  return place;
}

}  // namespace supernormal
