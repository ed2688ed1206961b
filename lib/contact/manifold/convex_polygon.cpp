#include "contact/manifold/convex_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {

double ConvexPolygon::area() const {
  double twice = 0;
  for (int k = 1; k + 1 < size_; ++k) twice += cross((*this)[k] - vertices_[0], (*this)[k + 1] - vertices_[0]);
  return 0.5 * twice;
}

// Clips by Sutherland and Hodgman's algorithm (1974): the edges of the other polygon cut this one, one after the other. If edges
// coincide, as in a stack, rounding decides which vertices are kept, and no branch predictor foresees it. So every vertex is
// written, and only the count depends on the decision.
ConvexPolygon ConvexPolygon::intersected(const ConvexPolygon& other) const {
  using Vertices = std::array<Vector2, kCapacity + 2>;
  std::array<Vertices, 2> buffers;  // one holds the vertices to be cut, the other the vertices kept; they alternate
  std::copy_n(vertices_.begin(), size_, buffers[0].begin());
  auto count = static_cast<std::size_t>(size_);
  std::size_t current = 0;
  for (int edge = 0; edge < other.size() && count > 0; ++edge) {
    const Vertices& rest = buffers[current];
    Vertices& kept = buffers[1 - current];
    const Vector2& from = other[edge];
    const Vector2 along = other[edge + 1 < other.size() ? edge + 1 : 0] - from;
    std::size_t kept_count = 0;
    double side_here = cross(along, rest[0] - from);
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2 here = rest[k];
      const Vector2 next = rest[k + 1 < count ? k + 1 : 0];
      const double side_next = cross(along, next - from);
      const bool crosses = ((side_here > 0) & (side_next < 0)) | ((side_here < 0) & (side_next > 0));
      kept[kept_count] = here;
      kept_count += side_here >= 0 ? 1 : 0;
      kept[kept_count] = here + (next - here) * (side_here / (crosses ? side_here - side_next : 1));
      kept_count += crosses ? 1 : 0;
      kept_count = std::min(kept_count, std::size_t{kCapacity});
      side_here = side_next;
    }
    count = kept_count;
    current = 1 - current;
  }
  ConvexPolygon rest;
  std::copy_n(buffers[current].begin(), count, rest.vertices_.begin());
  rest.size_ = static_cast<int>(count);
  return rest;
}

std::array<Vector2, 4> ConvexPolygon::nearest_to(const std::array<Vector2, 4>& points) const {
  std::array<Vector2, 4> nearest;
  nearest.fill(vertices_[0]);
  std::array<double, 4> least;
  least.fill(HUGE_VAL);
  for (int k = 0; k < size_; ++k) {
    const Vector2 here = (*this)[k];
    const Vector2& next = (*this)[k + 1 < size_ ? k + 1 : 0];
    const Vector2 edge = next - here;
    const double length = edge.squaredNorm();
    const double divisor = length > 0 ? length : 1;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      const double share = std::clamp(edge.dot(points[i] - here) / divisor, 0.0, 1.0);
      const Vector2 candidate = share < 1 ? Vector2(here + share * edge) : next;  // a vertex without rounding
      const double distance = (points[i] - candidate).squaredNorm();
      if (distance >= least[i]) continue;
      least[i] = distance;
      nearest[i] = candidate;
    }
  }
  return nearest;
}

}  // namespace supernormal
