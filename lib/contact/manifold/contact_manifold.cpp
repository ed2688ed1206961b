#include "supernormal/contact/contact_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "contact/manifold/common_corners.hpp"
#include "contact/manifold/support_polygon.hpp"
#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/raycast/ray.hpp"

namespace supernormal {
namespace {

// A support point below a contact by less than this fraction of the smallest half-extent differs from it by rounding only.
constexpr double kBelow = 1e-12;

// Two manifold points nearer than this fraction of same_place differ by rounding only.
constexpr double kMoved = 0.01;

// Two manifold points are equally deep if their depths differ by less than this fraction of the distance above the deepest at which
// a point is shallow.
constexpr double kSameDepth = 1e-9;

// Adding this rounds to an integer, and keeps the order of larger numbers.
constexpr double kToWhole = 0x1.8p52;

// The weight of a shallow point (ContactManifold::shallow) when two points are merged, as a fraction of its height above the
// deepest.
constexpr double kLeastWeight = 0.01;

// Allowed separation of a manifold point beyond the depth, as a fraction of the reach. With a larger fraction, bodies fall asleep
// tilted. The allowed separation is smaller if all vertices are within kSmallPolygon least extents of the deepest point, as for a
// stubby capsule. The same separation is a larger angle there.
constexpr double kAllowedSeparation = 0.5;
constexpr double kSmallPolygon = 0.5;

// A line inside of the silhouette by this fraction of the body's size meets the body, at any rounding.
constexpr double kInside = 1e-9;

/// At any depth: a resting body has a depth of rounding only, and a body that stands on one point for a step slides.
bool overlaps(const Proximity& proximity) { return proximity.status != Status::Apart && proximity.gap < 0; }

/// Moves both points to one place between them, with the depth of the deeper one. So the deepest contact stays as deep as the
/// overlap. The deeper point has more weight, because its place matters when the body is tilted. Points up to the depth `floor`
/// have the least weight.
void merge(ManifoldCorner& corner, ManifoldCorner& other, double floor, double least_weight) {
  const double weight = std::max(0.0, corner.depth - floor) + least_weight;
  const double weight_of_other = std::max(0.0, other.depth - floor) + least_weight;
  const double share = weight_of_other / (weight + weight_of_other);
  corner.point += share * (other.point - corner.point);
  corner.depth = std::max(corner.depth, other.depth);
  other = corner;
}

/// Rotates the list so that the first two are the shallowest neighbours, if these are shallower than the first pair by `shallow`
/// (m). A deep point merged with a point far above stays where it is, and nothing supports the far one. The centre of a body that
/// comes down on the other three would then be over their border. In an overlap no point is so far above.
void put_shallowest_pair_first(std::array<ManifoldCorner, ContactManifold::kMaxCorners>& corners, double shallow) {
  const auto depth_of_pair = [&](std::size_t k) { return std::max(corners[k].depth, corners[(k + 1) % corners.size()].depth); };
  std::size_t shallowest = 0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    if (depth_of_pair(k) < depth_of_pair(shallowest)) shallowest = k;
  }
  if (depth_of_pair(0) - depth_of_pair(shallowest) <= shallow) return;
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(shallowest), corners.end());
}

/// Whether two of the points are within `distance` of each other.
bool are_near(std::span<const ManifoldCorner> corners, double distance) {
  for (std::size_t k = 1; k < corners.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      if ((corners[k].point - corners[other].point).squaredNorm() <= distance * distance) return true;
    }
  }
  return false;
}

/// Moves manifold points that are near each other to their mean, as deep as the deepest. Points at `distance` coincide, points at
/// twice the distance do not move.
void move_together(std::span<ManifoldCorner> corners, double distance) {
  std::array<ManifoldCorner, ContactManifold::kMaxCorners> drawn;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Vector3 sum = Vector3::Zero();
    double weights = 0;
    double depth = corners[k].depth;
    for (const ManifoldCorner& other : corners) {
      const double weight = std::clamp(2 - (other.point - corners[k].point).norm() / distance, 0.0, 1.0);
      sum += weight * (other.point - corners[k].point);
      weights += weight;
      depth = std::max(depth, corners[k].depth + weight * (other.depth - corners[k].depth));
    }
    drawn[k] = {corners[k].point + sum / weights, depth};
  }
  std::copy_n(drawn.begin(), corners.size(), corners.begin());
}

/// Keeps one of several manifold points at the same place, as deep as the deepest.
void remove_repeated(ContactManifold& manifold) {
  const double distance = kMoved * manifold.same_place;
  const auto kept = manifold.corners.begin();
  auto end = kept;
  for (const ManifoldCorner& corner : manifold.corners) {
    const auto there = std::find_if(
        kept, end, [&](const ManifoldCorner& other) { return (other.point - corner.point).squaredNorm() <= distance * distance; });
    const double depth = there == end ? corner.depth : std::max(there->depth, corner.depth);
    if (there == end) *end++ = corner;
    there->depth = depth;
  }
  manifold.corner_count = static_cast<int>(end - kept);
}

/// Joins manifold points that are near each other.
void join_near(ContactManifold& manifold) {
  if (!are_near(manifold.corners, 2 * manifold.same_place)) return;
  move_together(manifold.corners, manifold.same_place);
  remove_repeated(manifold);
}

/// Whether the manifold points are at more places than the two ends of an edge.
bool is_face(ContactManifold manifold) {
  join_near(manifold);
  return manifold.corner_count > 2;
}

/// Sorts the manifold points by depth. Points of equal depth up to rounding stay in order around the contact, because quickstep's
/// forces depend on the order.
void put_deepest_first(std::span<ManifoldCorner> corners, double shallow) {
  double depth = corners.front().depth;
  for (const ManifoldCorner& corner : corners) depth = std::max(depth, corner.depth);
  const double unit = kSameDepth * shallow;
  std::array<double, ContactManifold::kMaxCorners> units_above;
  for (std::size_t k = 0; k < corners.size(); ++k) units_above[k] = (depth - corners[k].depth) / unit + kToWhole;
  // By insertion: std::stable_sort would allocate memory.
  for (std::size_t next = 1; next < corners.size(); ++next) {
    for (std::size_t k = next; k > 0 && units_above[k] < units_above[k - 1]; --k) {
      std::swap(units_above[k], units_above[k - 1]);
      std::swap(corners[k], corners[k - 1]);
    }
  }
}

/// m; a manifold point on the polygon whose separation exceeds the depth by more than this is in the air. Faces count as flat
/// between the manifold points. So only differences of their separations matter (lib/contact/theory.md).
double allowed_separation(const SupportPolygon& polygon) {
  double farthest = 0;
  for (const Vector3& vertex : polygon.vertices()) farthest = std::max(farthest, vertex.norm());
  return kAllowedSeparation * polygon.reach() * std::min(1.0, farthest / (kSmallPolygon * polygon.least_extent()));
}

/// Writes the manifold points, where `gap` (m) is the gap of the one with the smallest separation. If the solver knows the gap of
/// each, a depth is minus its gap, and none moves: a point in the air supports nothing until it has come down. Otherwise a point
/// has at least the depth 0. If its gap exceeds `allowed_separation` (m), it moves in towards the deepest point, to where the gap
/// is just as much.
void write_corners(const CornerList& corners, bool of_gaps, double allowed_separation, double gap, ContactManifold& manifold) {
  const double depth = -gap;
  const double least = *std::min_element(corners.separations.begin(), corners.separations.end());
  const Vector3& deepest = manifold.deepest.contact;
  const double margin_at_deepest = std::max(0.0, depth + allowed_separation + std::min(0.0, least));
  for (std::size_t k = 0; k < corners.points.size(); ++k) {
    ManifoldCorner& corner = manifold.corners[k] = {corners.points[k], depth - (corners.separations[k] - least)};
    if (of_gaps) continue;
    const double margin = corner.depth + allowed_separation;
    const double fraction = margin < 0 ? margin_at_deepest / (margin_at_deepest - margin) : 1;
    corner.point = deepest + fraction * (corner.point - deepest);
    corner.depth = std::max(0.0, depth - fraction * (depth - corner.depth));
  }
  manifold.corner_count = ContactManifold::kMaxCorners;
}

/// Moves the manifold points to the boundary of manifold.placed_on. `vertices` are the vertices of its polygon at the points.
void put_on_body(const SupportPolygon& polygon, const CornerList::Vertices& vertices, ContactManifold& manifold) {
  if (!manifold.placed_on) return;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    Vector3& point = manifold.corners[k].point;
    const auto vertex = static_cast<std::size_t>(vertices[k]);
    if (vertices[k] < 0 || std::isnan(polygon.separations()[vertex])) {
      put_on_boundary(manifold, point);
    } else {
      point = polygon.support_point() + polygon.vertices()[vertex] - polygon.separations()[vertex] * manifold.placed_on->outwards;
    }
  }
}

ContactManifold find_manifold(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                              const Proximity& proximity, double approach, std::optional<double> share) {
  ContactManifold manifold(proximity);
  const Vector3& n = proximity.normal;
  if (share == 1) manifold.placed_on = {&shape1, pose1, n};
  if (share == 0) manifold.placed_on = {&shape2, pose2, -n};
  if (proximity.status == Status::InvalidInput || !may_have_corners(shape1) || !may_have_corners(shape2)) return manifold;
  const double depth = std::max({0.0, -proximity.gap, approach});
  const SupportPolygon polygon1(shape1, pose1, n, proximity.point1, depth, !share, shape2.half_extents().minCoeff());
  manifold.evaluations = polygon1.evaluations();
  if (!polygon1.has_width()) return manifold;
  const SupportPolygon polygon2(shape2, pose2, -n, proximity.point2, depth, !share, shape1.half_extents().minCoeff());
  manifold.evaluations += polygon2.evaluations();
  if (!polygon2.has_width()) return manifold;
  const std::optional<CornerList> corners = find_common_corners(polygon1, polygon2, n, proximity.contact);
  if (corners) {
    const double allowed = std::min(allowed_separation(polygon1), allowed_separation(polygon2));
    write_corners(*corners, share.has_value(), allowed, proximity.gap, manifold);
    put_on_body(share == 1 ? polygon1 : polygon2, corners->vertices[share == 1 ? 0 : 1], manifold);
  }
  manifold.same_place = kSamePlace * std::min(polygon1.size(), polygon2.size());
  if (share) manifold.shallow = kShallow * manifold.same_place;
  manifold.margin = std::max(0.0, polygon1.largest_separation() + polygon2.largest_separation() + proximity.gap);
  return manifold;
}

ContactManifold find_plane_manifold(const Shape& shape, const Pose& pose, const Proximity& proximity, double approach,
                                    bool of_gaps) {
  ContactManifold manifold(proximity);
  if (of_gaps) manifold.placed_on = {&shape, pose, proximity.normal};
  if (proximity.status == Status::InvalidInput || !may_have_corners(shape)) return manifold;
  Vector3 stands_on = proximity.point1;
  double gap = proximity.gap;
  // Only the closed form of a plane has no error, and its point is the support point. At the border of a sheet the contact may be
  // beside the point on which the body would stand if the sheet continued.
  if (proximity.global_error > 0) {
    const Vector3 support_point = pose.rotation * shape.point(pose.rotation.transpose() * proximity.normal) + pose.position;
    ++manifold.evaluations;
    const double below = proximity.normal.dot(support_point - proximity.point1);
    if (below > kBelow * shape.half_extents().minCoeff()) {
      stands_on = support_point;
      gap -= below;
    }
  }
  const SupportPolygon polygon(shape, pose, proximity.normal, stands_on, std::max({0.0, -gap, approach}), !of_gaps);
  manifold.evaluations += polygon.evaluations();
  if (!polygon.has_width()) return manifold;
  const CornerList corners = corners_over_plane(polygon, proximity.normal);
  write_corners(corners, of_gaps, allowed_separation(polygon), gap, manifold);
  put_on_body(polygon, corners.vertices[0], manifold);
  manifold.same_place = kSamePlace * polygon.size();
  if (of_gaps) manifold.shallow = kShallow * manifold.same_place;
  manifold.margin = std::max(0.0, polygon.largest_separation() + gap);
  return manifold;
}

}  // namespace

void put_on_boundary(ContactManifold& manifold, Vector3& point, Beside beside) {
  if (!manifold.placed_on) return;
  const auto& [shape, pose, outwards] = *manifold.placed_on;
  const double far = 2 * shape->bounding_radius();
  RayHit hit = find_ray_hit(*shape, pose, point + far * outwards, -outwards, HUGE_VAL);
  manifold.evaluations += hit.evaluations;
  if (!hit.hit && beside == Beside::MovesToSilhouette) {
    // On a side along the normal, the point nearest to the line is not unique. A line just inside meets the outermost of them.
    const Proximity nearest = find_ray_proximity(*shape, pose, point + far * outwards, -outwards, HUGE_VAL);
    point += nearest.point1 - nearest.point2 - kInside * far * nearest.normal;
    hit = find_ray_hit(*shape, pose, point + far * outwards, -outwards, HUGE_VAL);
    manifold.evaluations += nearest.evaluations + hit.evaluations;
    if (!hit.hit) point = nearest.point1;
  }
  if (hit.hit) point = hit.point;
}

ContactManifold find_contact_manifold(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                      const Proximity& proximity) {
  if (!overlaps(proximity)) return proximity;
  return find_manifold(shape1, pose1, shape2, pose2, proximity, 0, std::nullopt);
}

ContactManifold find_plane_contact_manifold(const Shape& shape, const Pose& pose, const Proximity& proximity) {
  if (!overlaps(proximity)) return proximity;
  return find_plane_manifold(shape, pose, proximity, 0, false);
}

ContactManifold find_manifold_of_gaps(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                      const Proximity& proximity, double share, double approach) {
  Proximity placed = proximity;
  placed.contact += (0.5 - share) * proximity.gap * proximity.normal;
  return find_manifold(shape1, pose1, shape2, pose2, placed, approach, share);
}

ContactManifold find_plane_manifold_of_gaps(const Shape& shape, const Pose& pose, const Proximity& proximity, double approach) {
  return find_plane_manifold(shape, pose, proximity, approach, true);
}

// Which points are merged does not depend on their places, and points that approach each other move together before they become
// one. So no force jumps. Quickstep starts each step from zero and ends before it has converged, so the first contact carries more.
// Bodies drift least if the deepest is first (lib/contact/README.md).
//
// Two contacts let a body rotate about the line through them. A body that is about to meet a face still has all its velocity. With
// max_contacts 2 it is stopped at one place, near the line through its centre of mass (ahead/small_rotation).
ContactManifold reduced_to(ContactManifold manifold, int max_contacts) {
  if (max_contacts < 2) manifold.corner_count = 0;
  if (manifold.corner_count == 0) return manifold;
  std::array<ManifoldCorner, ContactManifold::kMaxCorners>& corners = manifold.corners;
  const std::array<ManifoldCorner, ContactManifold::kMaxCorners> given = corners;
  const bool may_arrive = std::max(manifold.reach, manifold.deepest.gap) > 0;
  if (max_contacts == 2 && may_arrive && is_face(manifold)) {
    manifold.corner_count = 0;
    return manifold;
  }
  const double depth = -manifold.deepest.gap;
  const double shallow = std::max(depth, manifold.shallow);
  const double least_weight = kLeastWeight * shallow;
  if (max_contacts == 3) put_shallowest_pair_first(corners, shallow);
  if (max_contacts < 4) merge(corners[0], corners[1], depth - shallow, least_weight);
  if (max_contacts < 3) merge(corners[2], corners[3], depth - shallow, least_weight);
  join_near(manifold);
  for (ManifoldCorner& corner : std::span(corners).first(static_cast<std::size_t>(manifold.corner_count))) {
    const auto is_here = [&](const ManifoldCorner& other) { return other.point == corner.point; };
    if (std::ranges::none_of(given, is_here)) put_on_boundary(manifold, corner.point, Beside::Stays);
  }
  put_deepest_first({corners.begin(), static_cast<std::size_t>(manifold.corner_count)}, shallow);
  corners[0].depth = depth;  // equal up to rounding
  return manifold;
}

}  // namespace supernormal
