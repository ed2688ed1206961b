#include "supernormal/contact/contact_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "contact/manifold/convex_polygon.hpp"
#include "contact/manifold/support_polygon.hpp"
#include "contact/manifold/unit_root.hpp"
#include "shapes/validation.hpp"

namespace supernormal {
namespace {

// A depth below this share of the smallest half-extent is rounding.
constexpr double kLeastDepth = 1e-12;

// Corners that are nearer to each other than this share of the body's extent are one; from twice that on they are two, and in
// between they move together.
constexpr double kSamePlace = 0.01;

// Two corners that are nearer than this share of that length differ by rounding only.
constexpr double kMoved = 0.01;

// A line of contact is this much wider than nothing, relative to the body's smaller extent along the plane.
constexpr double kThinnest = 1e-3;

// Corners are looked for from so many times the reach of the region: far enough to find those of a square that is turned by
// 25 degrees, near enough to move along an edge, and not to jump, when it is turned by 45.
constexpr double kLookFrom = 1.5;

// Two corners are equally deep when their depths differ by less than this share.
constexpr double kSameDepth = 1e-9;

// A corner of depth 0 has this share of the deepest point's depth as its weight where two are united.
constexpr double kLeastShare = 0.01;

// Plates and segments have no thickness to be deep in, nor have shapes that are thinner than a body of ours may be.
bool may_have_corners(const Shape& shape, const Proximity& proximity) {
  const bool is_answer = proximity.status != Status::InvalidInput && proximity.status != Status::Apart;
  const double thickness = shape.half_extents().minCoeff();
  return is_answer && !shape.is_round() && thickness >= kMinLength && -proximity.gap > kLeastDepth * thickness;
}

/// Points on which the bodies may rest, and how far the faces lean away from one another there, m.
struct CornerList {
  std::array<Vector3, ContactManifold::kMaxCorners> points;
  std::array<double, ContactManifold::kMaxCorners> leans;

  /// Faces count as flat between their corners: what counts is by how much a corner leans more than another. A corner that leans by
  /// more than `depth`, where it does not lean, and `largest_lean` (m) is drawn in towards the deepest point, to where the faces
  /// lean by as much.
  void write(double largest_lean, double depth, ContactManifold& manifold) const {
    const double least = *std::min_element(leans.begin(), leans.end());
    const Vector3& deepest = manifold.deepest.contact;
    const double left_at_deepest = std::max(0.0, depth + largest_lean + std::min(0.0, least));
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double lean = leans[k] - least;
      const double left = depth + largest_lean - lean;
      const double share = left < 0 ? left_at_deepest / (left_at_deepest - left) : 1;
      manifold.corners[k] = {deepest + share * (points[k] - deepest), std::max(0.0, depth - share * lean)};
    }
    manifold.corner_count = ContactManifold::kMaxCorners;
  }
};

/// A support polygon in the coordinates of the contact, counter-clockwise.
class Side {
 public:
  Side(const SupportPolygon& polygon, const ContactFrame& frame, bool sees_it_from_below)
      : axis_(frame.plane.project(polygon.axis())), area_(polygon.area()) {
    const Vector2 support_point = frame.project(polygon.support_point());
    // A line gets a width, so that two of them have a region in common.
    const Vector2 thin = kThinnest * polygon.size() * axis_;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t vertex = sees_it_from_below ? 3 - k : k;
      const Vector2 beside = vertex == 0 || vertex == 3 ? thin : Vector2(-thin);
      outline_.add(support_point + frame.plane.project(polygon.vertices()[vertex]) + (polygon.is_long() ? beside : Vector2(0, 0)));
    }
  }

  const ConvexPolygon& outline() const { return outline_; }

  /// The direction of the axes, the same for all four of them, as a complex number whose length grows as the body gets smaller.
  Vector2 direction() const { return fourth_power(axis_) / (area_ * area_); }

 private:
  ConvexPolygon outline_;
  Vector2 axis_;
  double area_;
};

/// The common directions of the axes of both bodies, in which the smaller body has more weight.
std::array<Vector2, 2> common_axes(const Side& side1, const Side& side2) {
  const Vector2 sum = side1.direction() + side2.direction();
  const Vector2 first = sum.squaredNorm() > 0 ? direction_of_fourth_power(sum) : Vector2(Vector2::UnitX());
  return {first, Vector2(-first.y(), first.x())};
}

/// The intersection of both polygons, which may be empty.
ConvexPolygon common_region(const ConvexPolygon& outline1, const ConvexPolygon& outline2) {
  const bool thinner = outline1.area() < outline2.area();  // an edge of a box has no area
  return thinner ? outline1.intersected(outline2) : outline2.intersected(outline1);
}

/// Finds four corners of a region that is not empty.
CornerList corners_of(const ConvexPolygon& region, const Side& side1, const Side& side2, const ContactFrame& frame,
                      const Vector2& lean) {
  double squared_reach = 0;
  for (int k = 0; k < region.size(); ++k) squared_reach = std::max(squared_reach, region[k].squaredNorm());
  const double reach = std::sqrt(squared_reach);
  const auto [u, v] = common_axes(side1, side2);
  const std::array<Vector2, 4> diagonals = {u + v, v - u, -u - v, u - v};
  CornerList corners;
  for (std::size_t k = 0; k < diagonals.size(); ++k) {
    const Vector2 corner = region.nearest_to(kLookFrom * reach * diagonals[k]);
    corners.points[k] = frame.lift(corner);
    corners.leans[k] = lean.dot(corner);
  }
  return corners;
}

/// Moves both corners to one place between them, with the depth of the deeper one, so that the deepest contact stays as deep as
/// the overlap. The deeper of two has more weight: where the body leans, its place matters.
void unite(ManifoldCorner& corner, ManifoldCorner& other, double least_depth) {
  const double weight = corner.depth + least_depth;
  const double weight_of_other = other.depth + least_depth;
  const double share = weight_of_other / (weight + weight_of_other);
  corner.point += share * (other.point - corner.point);
  corner.depth = std::max(corner.depth, other.depth);
  other = corner;
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

/// Sorts the corners by depth. Those that are equally deep but for rounding stay in order around the contact, because quickstep's
/// forces depend on the order.
void put_deepest_first(std::span<ManifoldCorner> corners) {
  double depth = 0;
  for (const ManifoldCorner& corner : corners) depth = std::max(depth, corner.depth);
  const auto units_above = [&](const ManifoldCorner& corner) { return std::round((depth - corner.depth) / (kSameDepth * depth)); };
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
  const SupportPolygon polygon1(shape1, pose1, proximity.normal, proximity.point1, depth);
  manifold.evaluations = polygon1.evaluations();
  if (!polygon1.has_width()) return manifold;
  const SupportPolygon polygon2(shape2, pose2, -proximity.normal, proximity.point2, depth);
  manifold.evaluations += polygon2.evaluations();
  if (!polygon2.has_width()) return manifold;
  const bool is_on_edge2 = polygon2.is_long() && !polygon1.is_long();
  const ContactFrame frame{TangentPlane(proximity.normal, is_on_edge2 ? polygon2.axis() : polygon1.axis()), proximity.contact};
  const Side side1(polygon1, frame, false);
  const Side side2(polygon2, frame, true);
  const ConvexPolygon region = common_region(side1.outline(), side2.outline());
  if (region.size() > 0) {
    const Vector2 lean = frame.plane.project(polygon1.slope() + polygon2.slope());
    corners_of(region, side1, side2, frame, lean)
        .write(std::min(polygon1.largest_lean(), polygon2.largest_lean()), depth, manifold);
  }
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
  const bool is_beside = below > kLeastDepth * shape.half_extents().minCoeff();
  const Vector3& stands_on = is_beside ? support_point : proximity.point1;
  const double depth = is_beside ? below - proximity.gap : -proximity.gap;
  const SupportPolygon polygon(shape, pose, proximity.normal, stands_on, depth);
  manifold.evaluations = polygon.evaluations();
  if (!polygon.has_width()) return manifold;
  CornerList corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners.leans[k] = polygon.slope().dot(polygon.vertices()[k]);
    // On the face, whose rounding does not count: a body that rolls on a line has the radius of its equator.
    corners.points[k] = stands_on + polygon.vertices()[k] - std::max(0.0, corners.leans[k]) * proximity.normal;
  }
  corners.write(polygon.largest_lean(), depth, manifold);
  manifold.same_place = kSamePlace * polygon.size();
  manifold.margin = std::max(0.0, polygon.largest_separation() - depth);
  return manifold;
}

// Which corners are united does not depend on where they are, and corners that approach each other are drawn together before they
// become one: so no force jumps. Quickstep starts each step from zero and ends before it has converged, so that the contact that
// comes first carries more: with the deepest first, bodies drift least (lib/contact/README.md).
ContactManifold reduced_to(ContactManifold manifold, int room) {
  if (room < 2) manifold.corner_count = 0;
  if (manifold.corner_count == 0) return manifold;
  std::array<ManifoldCorner, ContactManifold::kMaxCorners>& corners = manifold.corners;
  const double least_depth = -kLeastShare * manifold.deepest.gap;
  if (room < 4) unite(corners[0], corners[1], least_depth);
  if (room < 3) unite(corners[2], corners[3], least_depth);
  draw_together(corners, manifold.same_place);
  remove_repeated(manifold);
  put_deepest_first({corners.begin(), static_cast<std::size_t>(manifold.corner_count)});
  corners[0].depth = -manifold.deepest.gap;  // but for rounding it is
  return manifold;
}

}  // namespace supernormal
