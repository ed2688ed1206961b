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

/// Points on which the bodies may rest, and how far their surfaces are below the tangent planes there.
struct CornerList {
  std::array<Vector3, ContactManifold::kMaxCorners> points;
  std::array<double, ContactManifold::kMaxCorners> drops;

  /// The drop that all corners of a flat face have in common is its rounding: the face as a whole is as deep as the deepest
  /// point. The drop that one corner has beyond another is the lean. A corner that leans by more than `largest_lean` (m) is drawn
  /// in to the deepest point, as the square of the excess: it is in the air, and would hold the body there.
  void write(double largest_lean, ContactManifold& manifold) const {
    const double least = *std::min_element(drops.begin(), drops.end());
    const Vector3& deepest = manifold.deepest.contact;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double lean = drops[k] - least;
      const double share = lean > largest_lean ? largest_lean / lean : 1;
      manifold.corners[k] = {deepest + share * share * (points[k] - deepest), std::max(0.0, -manifold.deepest.gap - lean)};
    }
    manifold.corner_count = ContactManifold::kMaxCorners;
  }
};

/// A support polygon in the coordinates of the contact, counter-clockwise.
class Side {
 public:
  Side(const SupportPolygon& polygon, const ContactFrame& frame, bool sees_it_from_below)
      : apex_(frame.project(polygon.support_point())), axis_(frame.plane.project(polygon.axis())), area_(polygon.area()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const SupportPolygon::Vertex& vertex = polygon.vertices()[sees_it_from_below ? 3 - k : k];
      x_[k] = frame.plane.t1.dot(vertex.offset);
      y_[k] = frame.plane.t2.dot(vertex.offset);
      drops_[k] = vertex.drop;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      inverse_areas_[k] = inverse_area(spoke(k), spoke((k + 1) % 4));
      has_parallel_spokes_ = has_parallel_spokes_ || inverse_areas_[k] == 0;
    }
  }

  /// The support point, which the polygon need not contain.
  const Vector2& apex() const { return apex_; }

  ConvexPolygon outline() const {
    ConvexPolygon outline;
    for (std::size_t k = 0; k < 4; ++k) outline.add(apex_ + spoke(k));
    return outline;
  }

  /// A bound on how far the surface is below the tangent plane at the point, from the triangles between the support point and two
  /// neighbouring vertices, which lie in the body.
  double drop_at(const Vector2& point) const {
    const Vector2 way = point - apex_;
    std::array<double, 5> across;  // cross products of the spokes and the way; the first one is repeated
    for (std::size_t k = 0; k < 4; ++k) across[k] = x_[k] * way.y() - y_[k] * way.x();
    across[4] = across[0];
    // Each triangle has shares of its two spokes; `outside` is positive when the point is outside it.
    std::array<double, 4> share1, share2, outside;
    for (std::size_t k = 0; k < 4; ++k) {
      share1[k] = -across[k + 1] * inverse_areas_[k];
      share2[k] = across[k] * inverse_areas_[k];
    }
    for (std::size_t k = 0; has_parallel_spokes_ && k < 4; ++k) {
      if (inverse_areas_[k] != 0) continue;
      const Vector2 share = share_along_longer(spoke(k), spoke((k + 1) % 4), way);
      share1[k] = share.x();
      share2[k] = share.y();
    }
    for (std::size_t k = 0; k < 4; ++k) outside[k] = std::max(std::max(-share1[k], -share2[k]), share1[k] + share2[k] - 1);
    // The nearest triangle is the one that contains the point, or that the point is least outside of.
    const std::size_t nearest02 = outside[2] < outside[0] ? 2 : 0, nearest13 = outside[3] < outside[1] ? 3 : 1;
    const std::size_t nearest = outside[nearest13] < outside[nearest02] ? nearest13 : nearest02;
    const double first = std::clamp(share1[nearest], 0.0, 1.0);
    return first * drops_[nearest] + std::clamp(share2[nearest], 0.0, 1 - first) * drops_[(nearest + 1) % 4];
  }

  /// The direction of the axes, the same for all four of them, as a complex number whose length grows as the body gets smaller.
  Vector2 direction() const { return fourth_power(axis_) / (area_ * area_); }

 private:
  /// Inverse of the area between two vectors; 0 if they are parallel.
  static double inverse_area(const Vector2& spoke1, const Vector2& spoke2) {
    const double area = cross(spoke1, spoke2);
    return area * area > 1e-24 * spoke1.squaredNorm() * spoke2.squaredNorm() ? 1 / area : 0;
  }

  /// Coordinates of a point with respect to two spokes that are parallel.
  static Vector2 share_along_longer(const Vector2& spoke1, const Vector2& spoke2, const Vector2& point) {
    const double length1 = spoke1.squaredNorm();
    const double length2 = spoke2.squaredNorm();
    if (!(std::max(length1, length2) > 0)) return {0, 0};
    return length1 >= length2 ? Vector2(point.dot(spoke1) / length1, 0) : Vector2(0, point.dot(spoke2) / length2);
  }

  /// The vector from the apex to a corner.
  Vector2 spoke(std::size_t k) const { return {x_[k], y_[k]}; }

  Vector2 apex_;
  // Coordinates of the spokes, the vectors from the apex to the corners. They are stored by coordinate because the compiler
  // vectorises operations on all four, two at a time.
  std::array<double, 4> x_{}, y_{};
  std::array<double, 4> drops_{};
  std::array<double, 4> inverse_areas_{};  // inverse areas of the parallelograms between two spokes
  bool has_parallel_spokes_ = false;
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

/// Moves the deepest point, which is at the origin, into the region that both sides and their support points have in common. For
/// two faces the query knows the normal, but it knows the place of the support points on them to no digit, and the contact
/// between these may be beside a body that the other one hangs over.
Vector2 place_of_deepest(const ConvexPolygon& region, const Side& side1, const Side& side2) {
  if (region.contains(Vector2::Zero())) return Vector2::Zero();
  const ConvexPolygon whole = common_region(side1.outline().with(side1.apex()), side2.outline().with(side2.apex()));
  return whole.size() == 0 || whole.contains(Vector2::Zero()) ? Vector2::Zero() : whole.nearest_to(Vector2::Zero());
}

/// Finds four corners of a region that is not empty.
CornerList corners_of(const ConvexPolygon& region, const Side& side1, const Side& side2, const ContactFrame& frame) {
  double squared_reach = 0;
  for (int k = 0; k < region.size(); ++k) squared_reach = std::max(squared_reach, region[k].squaredNorm());
  const double reach = std::sqrt(squared_reach);
  const auto [u, v] = common_axes(side1, side2);
  const std::array<Vector2, 4> diagonals = {u + v, v - u, -u - v, u - v};
  CornerList corners;
  for (std::size_t k = 0; k < diagonals.size(); ++k) {
    const Vector2 corner = region.nearest_to(kLookFrom * reach * diagonals[k]);
    corners.points[k] = frame.lift(corner);
    corners.drops[k] = side1.drop_at(corner) + side2.drop_at(corner);
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

/// Moves two corners that are near to each other towards the middle between them, with the depth of the deeper one: not at all
/// from twice the distance on, to one place within it.
void draw_together(ManifoldCorner& corner, ManifoldCorner& other, double distance) {
  const Vector3 way = other.point - corner.point;
  const double squared_length = way.squaredNorm();
  if (!(squared_length < 4 * distance * distance)) return;
  const double share = std::min(1.0, 2 - std::sqrt(squared_length) / distance);
  corner.point += 0.5 * share * way;
  other.point -= 0.5 * share * way;
  const double depth = std::max(corner.depth, other.depth);
  corner.depth += share * (depth - corner.depth);
  other.depth += share * (depth - other.depth);
}

/// Keeps one of several corners at the same place.
void remove_repeated(ContactManifold& manifold, bool deepest_counts) {
  const double distance = kMoved * manifold.same_place;
  const auto is_at = [&](const Vector3& place, const Vector3& point) {
    return (place - point).squaredNorm() <= distance * distance;
  };
  const auto kept = manifold.corners.begin();
  auto end = kept;
  for (const ManifoldCorner& corner : manifold.corners) {
    const bool is_repeated = std::any_of(kept, end, [&](const ManifoldCorner& other) { return is_at(other.point, corner.point); });
    if (is_repeated || (deepest_counts && is_at(manifold.deepest.contact, corner.point))) continue;
    *end++ = corner;
  }
  manifold.corner_count = static_cast<int>(end - kept);
}

/// Rotates the corners so that the deepest comes first, as programs expect. Among those that are equally deep but for rounding,
/// the first one is taken as the deepest, because quickstep's forces depend on the order.
void put_deepest_first(std::span<ManifoldCorner> corners) {
  double depth = 0;
  for (const ManifoldCorner& corner : corners) depth = std::max(depth, corner.depth);
  const auto is_deepest = [&](const ManifoldCorner& corner) { return corner.depth >= (1 - kSameDepth) * depth; };
  std::rotate(corners.begin(), std::find_if(corners.begin(), corners.end(), is_deepest), corners.end());
}

}  // namespace

ContactManifold find_contact_manifold(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                      const Proximity& proximity) {
  ContactManifold manifold(proximity);
  if (!may_have_corners(shape1, proximity) || !may_have_corners(shape2, proximity)) return manifold;
  const double depth = -proximity.gap;
  const SupportPolygon polygon1(shape1, pose1, proximity.normal, proximity.point1, depth);
  manifold.evaluations = polygon1.evaluations();
  if (polygon1.flatness() == 0) return manifold;
  const SupportPolygon polygon2(shape2, pose2, -proximity.normal, proximity.point2, depth);
  manifold.evaluations += polygon2.evaluations();
  if (polygon2.flatness() == 0) return manifold;
  const bool is_on_edge2 = polygon2.has_straight_edge() && !polygon1.has_straight_edge();
  const ContactFrame frame{TangentPlane(proximity.normal, is_on_edge2 ? polygon2.axis() : polygon1.axis()), proximity.contact};
  const Side side1(polygon1, frame, false);
  const Side side2(polygon2, frame, true);
  const ConvexPolygon region = common_region(side1.outline(), side2.outline());
  manifold.flatness = polygon1.flatness() * polygon2.flatness();
  manifold.deepest.contact = frame.lift(manifold.flatness * place_of_deepest(region, side1, side2));
  if (region.size() > 0) {
    corners_of(region, side1, side2, frame).write(std::min(polygon1.largest_lean(), polygon2.largest_lean()), manifold);
  }
  manifold.same_place = kSamePlace * std::min(polygon1.size(), polygon2.size());
  manifold.margin = polygon1.reach() + polygon2.reach() - depth;
  return manifold;
}

ContactManifold find_plane_contact_manifold(const Shape& shape, const Pose& pose, const Proximity& proximity) {
  ContactManifold manifold(proximity);
  if (!may_have_corners(shape, proximity)) return manifold;
  const double depth = -proximity.gap;
  const SupportPolygon polygon(shape, pose, proximity.normal, proximity.point1, depth);
  manifold.evaluations = polygon.evaluations();
  if (polygon.flatness() == 0) return manifold;
  CornerList corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners.points[k] = proximity.point1 + polygon.vertices()[k].offset;
    corners.drops[k] = polygon.vertices()[k].drop;
  }
  corners.write(polygon.largest_lean(), manifold);
  manifold.same_place = kSamePlace * polygon.size();
  manifold.flatness = polygon.flatness();
  manifold.margin = polygon.reach() - depth;
  return manifold;
}

// Which corners are united does not depend on where they are, and corners that approach each other are drawn together before they
// become one: so no force jumps.
ContactManifold reduced_to(ContactManifold manifold, int room) {
  if (room < 2) manifold.corner_count = 0;
  if (manifold.corner_count == 0) return manifold;
  std::array<ManifoldCorner, ContactManifold::kMaxCorners>& corners = manifold.corners;
  const double least_depth = -kLeastShare * manifold.deepest.gap;
  if (room < 4) unite(corners[0], corners[1], least_depth);
  if (room < 3) unite(corners[2], corners[3], least_depth);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    for (std::size_t other = k + 1; other < corners.size(); ++other) {
      draw_together(corners[k], corners[other], manifold.same_place);
    }
  }
  remove_repeated(manifold, has_room_for_deepest(room));
  if (has_room_for_deepest(room)) return manifold;
  if (manifold.corner_count == 1) manifold.corner_count = 0;  // all corners are at one place, that of the deepest point
  put_deepest_first({corners.begin(), static_cast<std::size_t>(manifold.corner_count)});
  return manifold;
}

}  // namespace supernormal
