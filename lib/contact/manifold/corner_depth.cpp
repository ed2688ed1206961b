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

Vector3 find_boundary_point(const Shape& shape, const Pose& pose, const Vector3& normal, const Vector3& place, int& evaluations) {
  const RayHit hit = find_ray_hit(shape, pose, place + 2 * shape.bounding_radius() * normal, -normal, HUGE_VAL);
  evaluations += hit.evaluations;
  return hit.hit ? hit.point : place;
}

void put_on_body(const Shape& shape, const Pose& pose, const SupportPolygon& polygon, const Vector3& normal,
                 ContactManifold& manifold) {
  for (ManifoldCorner& corner : manifold.corners) {
    const Vector3 offset = corner.point - polygon.support_point();
    const Vector3 place = offset - normal.dot(offset) * normal;
    double separation = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < polygon.vertices().size(); ++k) {
      if ((polygon.vertices()[k] - place).norm() <= kSameVertex * polygon.size()) separation = polygon.separations()[k];
    }
    const Vector3 in_plane = polygon.support_point() + place;
    if (std::isnan(separation)) {
      separation = normal.dot(in_plane - find_boundary_point(shape, pose, normal, in_plane, manifold.evaluations));
    }
    const double of_rounding = separation - std::max(0.0, polygon.slope().dot(place));
    corner.point = in_plane - (separation - std::clamp(of_rounding, 0.0, polygon.rise())) * normal;
  }
}

}  // namespace supernormal
