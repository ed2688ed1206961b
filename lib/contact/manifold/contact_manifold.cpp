#include "supernormal/contact/contact_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "contact/manifold/common_corners.hpp"
#include "contact/manifold/support_polygon.hpp"

namespace supernormal {
namespace {

// A support point that is below a contact by less than this share of the smallest half-extent is there but for rounding.
constexpr double kBelow = 1e-12;

// Two corners that are nearer than this share of that length differ by rounding only.
constexpr double kMoved = 0.01;

// Two corners are equally deep when their depths differ by less than this share.
constexpr double kSameDepth = 1e-9;

// A corner of depth 0 has this share of the deepest point's depth as its weight where two are united; with contacts ahead, one
// that is ContactManifold::shallow above the deepest has this share of that.
constexpr double kLeastShare = 0.01;

/// At any depth: what rests has one of rounding alone, and a body that stands on a point for a step slides.
bool may_have_corners(const Shape& shape, const Proximity& proximity) {
  const bool is_answer = proximity.status != Status::InvalidInput && proximity.status != Status::Apart;
  return is_answer && may_have_corners(shape) && proximity.gap < 0;
}

/// Faces count as flat between their corners: what counts is by how much a corner leans more than another. A corner that leans by
/// more than `depth`, where it does not lean, and `largest_lean` (m) is drawn in towards the deepest point, to where the faces
/// lean by as much.
void write(const CornerList& corners, double largest_lean, double depth, ContactManifold& manifold) {
  const double least = *std::min_element(corners.leans.begin(), corners.leans.end());
  const Vector3& deepest = manifold.deepest.contact;
  const double left_at_deepest = std::max(0.0, depth + largest_lean + std::min(0.0, least));
  for (std::size_t k = 0; k < corners.points.size(); ++k) {
    const double lean = corners.leans[k] - least;
    const double left = depth + largest_lean - lean;
    const double share = left < 0 ? left_at_deepest / (left_at_deepest - left) : 1;
    manifold.corners[k] = {deepest + share * (corners.points[k] - deepest), std::max(0.0, depth - share * lean)};
  }
  manifold.corner_count = ContactManifold::kMaxCorners;
}

/// Moves both corners to one place between them, with the depth of the deeper one, so that the deepest contact stays as deep as
/// the overlap. The deeper of two has more weight: where the body leans, its place matters. Corners up to `floor` have the least.
void unite(ManifoldCorner& corner, ManifoldCorner& other, double floor, double least_weight) {
  const double weight = std::max(0.0, corner.depth - floor) + least_weight;
  const double weight_of_other = std::max(0.0, other.depth - floor) + least_weight;
  const double share = weight_of_other / (weight + weight_of_other);
  corner.point += share * (other.point - corner.point);
  corner.depth = std::max(corner.depth, other.depth);
  other = corner;
}

/// Rotates the corners so that the first two are the neighbours that are least deep, where these are less deep by `shallow` (m).
/// United with a corner that is far above, a deep one stays where it is, and the far one is held no more: a body that comes down
/// on the other three has its centre over their border. With contacts of overlaps no corner is so far above.
void put_highest_pair_first(std::array<ManifoldCorner, ContactManifold::kMaxCorners>& corners, double shallow) {
  const auto depth_of_pair = [&](std::size_t k) { return std::max(corners[k].depth, corners[(k + 1) % corners.size()].depth); };
  std::size_t highest = 0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    if (depth_of_pair(k) < depth_of_pair(highest)) highest = k;
  }
  if (depth_of_pair(0) - depth_of_pair(highest) <= shallow) return;
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(highest), corners.end());
}

/// Moves corners that are near to each other to their mean, as deep as the deepest of them: not at all from twice the distance on,
/// to one place within it.
void draw_together(std::span<ManifoldCorner> corners, double distance) {
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

/// Keeps one of several corners at the same place, as deep as the deepest of them.
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

/// Whether the corners are at more places than an edge has.
bool is_face(ContactManifold manifold) {
  draw_together(manifold.corners, manifold.same_place);
  remove_repeated(manifold);
  return manifold.corner_count > 2;
}

/// Sorts the corners by depth. Those that are equally deep but for rounding stay in order around the contact, because quickstep's
/// forces depend on the order.
void put_deepest_first(std::span<ManifoldCorner> corners, double shallow) {
  double depth = corners.front().depth;
  for (const ManifoldCorner& corner : corners) depth = std::max(depth, corner.depth);
  const double unit = kSameDepth * std::max(depth, shallow);
  const auto units_above = [&](const ManifoldCorner& corner) { return std::round((depth - corner.depth) / unit); };
  // By insertion: std::stable_sort would ask for memory.
  for (auto next = corners.begin(); next != corners.end(); ++next) {
    const auto place = std::upper_bound(
        corners.begin(), next, *next,
        [&](const ManifoldCorner& corner, const ManifoldCorner& other) { return units_above(corner) < units_above(other); });
    std::rotate(place, next, next + 1);
  }
}

}  // namespace

ContactManifold find_contact_manifold(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                      const Proximity& proximity) {
  ContactManifold manifold(proximity);
  if (!may_have_corners(shape1, proximity) || !may_have_corners(shape2, proximity)) return manifold;
  const double depth = -proximity.gap;
  const SupportPolygon polygon1(shape1, pose1, proximity.normal, proximity.point1, depth, shape2.half_extents().minCoeff());
  manifold.evaluations = polygon1.evaluations();
  if (!polygon1.has_width()) return manifold;
  const SupportPolygon polygon2(shape2, pose2, -proximity.normal, proximity.point2, depth, shape1.half_extents().minCoeff());
  manifold.evaluations += polygon2.evaluations();
  if (!polygon2.has_width()) return manifold;
  const std::optional<CornerList> corners = find_common_corners(polygon1, polygon2, proximity.normal, proximity.contact);
  if (corners) write(*corners, std::min(polygon1.largest_lean(), polygon2.largest_lean()), depth, manifold);
  manifold.same_place = kSamePlace * std::min(polygon1.size(), polygon2.size());
  manifold.margin = std::max(0.0, polygon1.largest_separation() + polygon2.largest_separation() - depth);
  return manifold;
}

ContactManifold find_plane_contact_manifold(const Shape& shape, const Pose& pose, const Proximity& proximity) {
  ContactManifold manifold(proximity);
  if (!may_have_corners(shape, proximity)) return manifold;
  // At the border of a sheet the contact is beside the point on which the body would stand if the sheet went on.
  const Vector3 support_point = pose.rotation * shape.point(pose.rotation.transpose() * proximity.normal) + pose.position;
  const double below = std::max(0.0, proximity.normal.dot(support_point - proximity.point1));
  const bool is_beside = below > kBelow * shape.half_extents().minCoeff();
  const Vector3& stands_on = is_beside ? support_point : proximity.point1;
  const double depth = is_beside ? below - proximity.gap : -proximity.gap;
  const SupportPolygon polygon(shape, pose, proximity.normal, stands_on, depth);
  manifold.evaluations = polygon.evaluations();
  if (!polygon.has_width()) return manifold;
  write(corners_over_plane(polygon, proximity.normal), polygon.largest_lean(), depth, manifold);
  manifold.same_place = kSamePlace * polygon.size();
  manifold.margin = std::max(0.0, polygon.largest_separation() - depth);
  return manifold;
}

// Which corners are united does not depend on where they are, and corners that approach each other are drawn together before they
// become one: so no force jumps. Quickstep starts each step from zero and ends before it has converged, so that the contact that
// comes first carries more: with the deepest first, bodies drift least (lib/contact/README.md).
// Two contacts let a body turn about the line through them. Where it has all its velocity yet, a face is stopped at one place, near
// the line through its centre of mass (ahead/small_turn).
ContactManifold reduced_to(ContactManifold manifold, int room) {
  if (room < 2) manifold.corner_count = 0;
  if (manifold.corner_count == 0) return manifold;
  std::array<ManifoldCorner, ContactManifold::kMaxCorners>& corners = manifold.corners;
  const bool is_ahead = manifold.shallow > 0;
  if (room == 2 && is_ahead && is_face(manifold)) {
    manifold.corner_count = 0;
    return manifold;
  }
  const double depth = -manifold.deepest.gap;
  const double shallow = std::max(depth, manifold.shallow);
  const double least_weight = kLeastShare * shallow;
  if (room == 3) put_highest_pair_first(corners, shallow);
  if (room < 4) unite(corners[0], corners[1], depth - shallow, least_weight);
  if (room < 3) unite(corners[2], corners[3], depth - shallow, least_weight);
  draw_together(corners, manifold.same_place);
  remove_repeated(manifold);
  put_deepest_first({corners.begin(), static_cast<std::size_t>(manifold.corner_count)}, manifold.shallow);
  corners[0].depth = depth;  // but for rounding it is
  return manifold;
}

}  // namespace supernormal
