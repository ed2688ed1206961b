#include "contact/footprint.hpp"

#include <algorithm>

namespace supernormal {
namespace {

// Of two corners that are as good the first counts, whatever the rounding.
constexpr double kClearly = 1 + 1e-9;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

// Sutherland and Hodgman (1974): the other polygon's edges cut this one, one after the other.
Footprint Footprint::intersected(const Footprint& other) const {
  Footprint rest = *this;
  for (int edge = 0; edge < other.size() && rest.size() > 0; ++edge) {
    const Vector2& from = other[edge];
    const Vector2 along = other[(edge + 1) % other.size()] - from;
    Footprint cut;
    for (int k = 0; k < rest.size(); ++k) {
      const Vector2& here = rest[k];
      const Vector2& next = rest[(k + 1) % rest.size()];
      const double side_here = cross(along, here - from);
      const double side_next = cross(along, next - from);
      if (side_here >= 0 && cut.size() < kCapacity) cut.add(here);
      const bool crosses = (side_here > 0 && side_next < 0) || (side_here < 0 && side_next > 0);
      if (crosses && cut.size() < kCapacity) cut.add(here + (next - here) * (side_here / (side_here - side_next)));
    }
    rest = cut;
  }
  return rest;
}

Footprint::Range Footprint::range(const Vector2& direction) const {
  Range range{direction.dot(corners_[0]), direction.dot(corners_[0])};
  for (int k = 1; k < size_; ++k) {
    const double coordinate = direction.dot((*this)[k]);
    range.low = std::min(range.low, coordinate);
    range.high = std::max(range.high, coordinate);
  }
  return range;
}

Footprint Footprint::quadrangle() const {
  if (size_ == 0) return {};
  int first = 0;
  int second = 0;
  double longest = 0;
  for (int i = 0; i < size_; ++i) {
    for (int k = i + 1; k < size_; ++k) {
      const double length = ((*this)[k] - (*this)[i]).squaredNorm();
      if (length <= kClearly * longest) continue;
      longest = length;
      first = i;
      second = k;
    }
  }
  Footprint result;
  result.add((*this)[first]);
  result.add((*this)[second]);
  int left = -1;
  int right = -1;
  double farthest_left = 0;
  double farthest_right = 0;
  for (int k = 0; k < size_; ++k) {
    const double side = cross(result[1] - result[0], (*this)[k] - result[0]);
    if (side > kClearly * farthest_left) {
      farthest_left = side;
      left = k;
    }
    if (side < kClearly * farthest_right) {
      farthest_right = side;
      right = k;
    }
  }
  if (left >= 0) result.add((*this)[left]);
  if (right >= 0) result.add((*this)[right]);
  return result;
}

}  // namespace supernormal
