#include "contact/manifold/convex_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {

double ConvexPolygon::area() const {
  double twice = 0;
  for (int k = 1; k + 1 < size_; ++k) twice += cross((*this)[k] - corners_[0], (*this)[k + 1] - corners_[0]);
  return 0.5 * twice;
}

// Clips by Sutherland and Hodgman's algorithm (1974): the other polygon's edges cut this one, one after the other.
ConvexPolygon ConvexPolygon::intersected(const ConvexPolygon& other) const {
  ConvexPolygon rest = *this;
  for (int edge = 0; edge < other.size() && rest.size() > 0; ++edge) {
    const Vector2& from = other[edge];
    const Vector2 along = other[(edge + 1) % other.size()] - from;
    ConvexPolygon cut;
    double side_here = cross(along, rest[0] - from);
    for (int k = 0; k < rest.size(); ++k) {
      const Vector2& here = rest[k];
      const Vector2& next = rest[(k + 1) % rest.size()];
      const double side_next = cross(along, next - from);
      if (side_here >= 0 && cut.size() < kCapacity) cut.add(here);
      const bool crosses = (side_here > 0 && side_next < 0) || (side_here < 0 && side_next > 0);
      if (crosses && cut.size() < kCapacity) cut.add(here + (next - here) * (side_here / (side_here - side_next)));
      side_here = side_next;
    }
    rest = cut;
  }
  return rest;
}

bool ConvexPolygon::contains(const Vector2& point) const {
  for (int k = 0; k < size_; ++k) {
    const Vector2& here = (*this)[k];
    if (!(cross((*this)[(k + 1) % size_] - here, point - here) >= 0)) return false;
  }
  return size_ > 0;
}

// The point replaces the corners between the edges that are visible from it.
ConvexPolygon ConvexPolygon::with(const Vector2& point) const {
  const auto is_seen = [&](int edge) {
    const Vector2& here = (*this)[edge];
    return cross((*this)[(edge + 1) % size_] - here, point - here) < 0;
  };
  ConvexPolygon hull;
  bool was_seen = is_seen(size_ - 1);
  for (int k = 0; k < size_; ++k) {
    const bool seen = is_seen(k);
    if (!(was_seen && seen)) hull.add((*this)[k]);
    if (!was_seen && seen) hull.add(point);
    was_seen = seen;
  }
  return hull;
}

Vector2 ConvexPolygon::nearest_to(const Vector2& point) const {
  Vector2 nearest = corners_[0];
  double least = HUGE_VAL;
  for (int k = 0; k < size_; ++k) {
    const Vector2& here = (*this)[k];
    const Vector2 edge = (*this)[(k + 1) % size_] - here;
    const double along = edge.dot(point - here);
    const double length = edge.squaredNorm();
    const Vector2 candidate = along > 0 && length > 0 ? Vector2(here + std::min(along / length, 1.0) * edge) : here;
    const double distance = (point - candidate).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace supernormal
