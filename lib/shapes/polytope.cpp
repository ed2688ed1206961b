#include "supernormal/shapes/polytope.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "base/validation.hpp"

namespace supernormal {

Polytope::Polytope(std::span<const Vector3> points) : points_(points) {
  if (points.empty()) throw std::invalid_argument("points is empty; at least one is needed");
  Vector3 low = points.front();
  Vector3 high = low;
  for (const Vector3& point : points) {
    for (int axis = 0; axis < 3; ++axis) require_in("coordinate of a point", point[axis], -kMaxLength, kMaxLength, "m");
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  half_extents_ = 0.5 * (high - low);
  bounding_radius_ = low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm();
}

void Polytope::evaluate(const Vector3& n, Order order, Jet& jet) const {
  const Vector3* highest = &points_.front();
  jet.h = n.dot(*highest);
  for (const Vector3& point : points_.subspan(1)) {
    const double height = n.dot(point);
    if (height <= jet.h) continue;
    jet.h = height;
    highest = &point;
  }
  if (order == Order::Value) return;
  jet.r = *highest;
  if (order == Order::Point) return;
  jet.H.setZero();
}

// The highest vertices along n come first, because they are the first to become boundary points.
void Polytope::add_active_vertices(const Vector3& n, const Vector3& /*toward*/, ActiveVertices& vertices) const {
  struct Height {
    double height;
    const Vector3* point;
  };
  std::array<Height, ActiveVertices::kCapacity> highest;
  std::size_t count = 0;
  for (const Vector3& point : points_) {
    const double height = n.dot(point);
    if (count == highest.size() && height <= highest.back().height) continue;
    if (count < highest.size()) ++count;
    std::size_t place = count - 1;
    for (; place > 0 && highest[place - 1].height < height; --place) highest[place] = highest[place - 1];
    highest[place] = {height, &point};
  }
  for (std::size_t k = 0; k < count; ++k) vertices.add(*highest[k].point);
  if (points_.size() > count) vertices.set_partial();
}

// The radius of curvature is 0 at vertices and edges.
double Polytope::min_curvature_radius_estimate() const { return 0; }

}  // namespace supernormal
