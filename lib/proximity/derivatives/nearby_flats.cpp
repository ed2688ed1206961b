#include "proximity/derivatives/nearby_flats.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal {
namespace {

// In sizes of the smaller body: a boundary point that moves by less does not jump. By as much the gradient of a rotation may be
// off.
constexpr double kJump = 1e-3;

// Of the displacement that the radii of curvature foresee: by more the radii have changed, and second derivatives are one-sided. In
// sizes of the smaller body: a shorter displacement does not count.
constexpr double kBend = 0.1;
constexpr double kLeastBend = 1e-5;

double product(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

bool TangentDirections::share_one_with(const TangentDirections& other) const {
  if (count == 0 || other.count == 0) return false;
  return count + other.count > 2 || std::abs(product(unit[0], other.unit[0])) <= kNearby;
}

NearbyFlats::NearbyFlats(const Shape& shape, const TangentPlane& plane, const Jet& jet, const BodyCurvature& curvature, double size)
    : plane_(plane), curvature_(curvature), point_(jet.r), size_(size) {
  is_possible_ = curvature.flat_count > 0 || kNearby * curvature.A.trace() > kLeastBend * size;
  if (shape.traits().has_nonsmooth_points) add_vertices(shape, jet);
}

/// Vertices that become boundary points as the normal rotates by kNearby.
void NearbyFlats::add_vertices(const Shape& shape, const Jet& jet) {
  ActiveVertices vertices;
  shape.add_active_vertices(plane_.n, jet.r, vertices);
  const double rounding = kTieUnits * std::numeric_limits<double>::epsilon() * shape.bounding_radius();
  for (int k = 0; k < vertices.size(); ++k) {
    const Vector2 across = plane_.project(vertices[k] - point_);
    if (jet.h - plane_.n.dot(vertices[k]) > kNearby * across.norm() + rounding) continue;
    displacements_[count_++] = {across, 0};
    is_possible_ = is_possible_ || across.norm() > kJump * size_;
  }
  Vector3 face;
  is_possible_ = is_possible_ || shape.crosses_curved_face((plane_.n - kNearby * plane_.t1).normalized(),
                                                           (plane_.n + kNearby * plane_.t1).normalized(), face);
}

void NearbyFlats::add(const Vector2& tilt, const Vector3& r) {
  const Vector2 moved = plane_.project(r - point_), foreseen = curvature_.A * tilt, excess = moved - foreseen;
  displacements_[count_++] = {excess.norm() < moved.norm() ? excess : moved, foreseen.norm()};
}

TangentDirections NearbyFlats::jumps() const { return directions(kJump * size_, 0); }

TangentDirections NearbyFlats::bends() const { return directions(kLeastBend * size_, kBend); }

/// The direction of the longest displacement, and the direction across it if some displacement is long enough across it.
TangentDirections NearbyFlats::directions(double least, double least_fraction) const {
  TangentDirections out;
  Vector2 longest = Vector2::Zero();
  const auto counts = [&](const Displacement& d, double length) { return length > std::max(least, least_fraction * d.foreseen); };
  for (std::size_t k = 0; k < count_; ++k) {
    const Displacement& d = displacements_[k];
    if (counts(d, d.excess.norm()) && d.excess.norm() > longest.norm()) longest = d.excess;
  }
  if (!(longest.norm() > 0)) return out;
  out.unit[0] = longest.normalized();
  out.unit[1] = {-out.unit[0].y(), out.unit[0].x()};
  out.count = 1;
  for (std::size_t k = 0; k < count_; ++k) {
    const Displacement& d = displacements_[k];
    if (counts(d, std::abs(product(out.unit[0], d.excess)))) out.count = 2;
  }
  return out;
}

}  // namespace supernormal
