#include "contact/manifold/corner_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "supernormal/raycast/ray.hpp"

namespace supernormal {
namespace {

// Allowed separation of a manifold point beyond the depth, as a fraction of the reach. With a larger fraction, bodies fall asleep
// tilted. The allowed separation is smaller if all vertices are within kSmallPolygon least extents of the deepest point, as for a
// stubby capsule. The same separation is a larger angle there.
constexpr double kAllowedSeparation = 0.5;
constexpr double kSmallPolygon = 0.5;

// A manifold point is a vertex of the polygon if it differs by less than this fraction of the smallest extent along the plane.
constexpr double kSameVertex = 1e-9;

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

void write_gaps(const CornerList& corners, double gap, ContactManifold& manifold) {
  const double least = *std::min_element(corners.separations.begin(), corners.separations.end());
  for (std::size_t k = 0; k < corners.points.size(); ++k) {
    manifold.corners[k] = {corners.points[k], least - corners.separations[k] - gap};
  }
  manifold.corner_count = ContactManifold::kMaxCorners;
}

void put_on_boundary(ContactManifold& manifold, Vector3& point) {
  if (!manifold.placed_on) return;
  const auto& [shape, pose, outwards] = *manifold.placed_on;
  const RayHit hit = find_ray_hit(*shape, pose, point + 2 * shape->bounding_radius() * outwards, -outwards, HUGE_VAL);
  manifold.evaluations += hit.evaluations;
  if (hit.hit) point = hit.point;
}

void put_on_body(const SupportPolygon& polygon, ContactManifold& manifold) {
  if (!manifold.placed_on) return;
  const Vector3& normal = manifold.placed_on->outwards;
  for (ManifoldCorner& corner : manifold.corners) {
    const Vector3 offset = corner.point - polygon.support_point();
    const Vector3 place = offset - normal.dot(offset) * normal;
    double separation = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < polygon.vertices().size(); ++k) {
      if ((polygon.vertices()[k] - place).norm() <= kSameVertex * polygon.size()) separation = polygon.separations()[k];
    }
    corner.point = polygon.support_point() + place;
    if (std::isnan(separation)) {
      put_on_boundary(manifold, corner.point);
    } else {
      corner.point -= separation * normal;
    }
  }
}

}  // namespace supernormal
