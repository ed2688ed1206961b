#include "contact/manifold/corner_depth.hpp"

#include <algorithm>

namespace supernormal {
namespace {

// Allowed separation of a manifold point beyond the depth, as a fraction of the reach. With a larger fraction, bodies fall asleep
// tilted. The allowed separation is smaller if all vertices are within kSmallPolygon least extents of the deepest point, as for a
// stubby capsule. The same separation is a larger angle there.
constexpr double kAllowedSeparation = 0.5;
constexpr double kSmallPolygon = 0.5;

}  // namespace

double allowed_separation(const SupportPolygon& polygon) {
  double farthest = 0;
  for (const Vector3& vertex : polygon.vertices()) farthest = std::max(farthest, vertex.norm());
  return kAllowedSeparation * polygon.reach() * std::min(1.0, farthest / (kSmallPolygon * polygon.least_extent()));
}

void write_depths(const CornerList& corners, double allowed_separation, double gap, ContactManifold& manifold) {
  const double depth = -gap;
  const double least = *std::min_element(corners.separations.begin(), corners.separations.end());
  const Vector3& deepest = manifold.deepest.contact;
  const double margin_at_deepest = std::max(0.0, depth + allowed_separation + std::min(0.0, least));
  for (std::size_t k = 0; k < corners.points.size(); ++k) {
    const double separation = corners.separations[k] - least;
    const double margin = depth + allowed_separation - separation;
    const double fraction = margin < 0 ? margin_at_deepest / (margin_at_deepest - margin) : 1;
    manifold.corners[k] = {deepest + fraction * (corners.points[k] - deepest), std::max(0.0, depth - fraction * separation)};
  }
  manifold.corner_count = ContactManifold::kMaxCorners;
}

void write_gaps(const CornerList& corners, double /*allowed_separation*/, double gap, ContactManifold& manifold) {
  const double least = *std::min_element(corners.separations.begin(), corners.separations.end());
  for (std::size_t k = 0; k < corners.points.size(); ++k) {
    manifold.corners[k] = {corners.points[k], least - corners.separations[k] - gap};
  }
  manifold.corner_count = ContactManifold::kMaxCorners;
}

}  // namespace supernormal
