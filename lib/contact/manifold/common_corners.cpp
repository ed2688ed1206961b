#include "contact/manifold/common_corners.hpp"

#include <algorithm>
#include <cmath>

#include "base/validation.hpp"
#include "contact/manifold/convex_polygon.hpp"

namespace supernormal {
namespace {

// The width of a line of contact, relative to the smallest extent of both bodies along the plane.
constexpr double kThinnest = 1e-3;

// Manifold points are the nearest points to four points outside, at this multiple of the region's radius. This is far enough to
// find the corners of a square that is turned by 25 degrees. It is near enough that points move along an edge, and do not jump,
// when the square is turned by 45 degrees.
constexpr double kLookFrom = 1.5;

/// A support polygon in the coordinates of the contact, counter-clockwise.
class Side {
 public:
  /// A line gets the width `thin`, m, so that two lines have a region in common.
  Side(const SupportPolygon& polygon, const ContactFrame& frame, bool sees_it_from_below, double thin)
      : sees_it_from_below_(sees_it_from_below), axis_(frame.plane.project(polygon.axis())), area_(polygon.area()) {
    const Vector2 support_point = frame.project(polygon.support_point());
    const Vector2 across = thin * axis_;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t vertex = sees_it_from_below ? 3 - k : k;
      const Vector2 beside = vertex == 0 || vertex == 3 ? across : Vector2(-across);
      outline_.add(support_point + frame.plane.project(polygon.vertices()[vertex]) + (polygon.is_long() ? beside : Vector2(0, 0)));
    }
  }

  const ConvexPolygon& outline() const { return outline_; }

  /// The vertex of the support polygon at a point of the outline; -1 if none is there.
  int vertex_at(const Vector2& point) const {
    for (int k = 0; k < outline_.size(); ++k) {
      if (outline_[k] == point) return sees_it_from_below_ ? 3 - k : k;
    }
    return -1;
  }

  /// The direction of the axes as a complex number, equal for all four of them. Its length increases as the body gets smaller.
  Vector2 direction() const { return fourth_power(axis_) / (area_ * area_); }

 private:
  bool sees_it_from_below_;
  ConvexPolygon outline_;
  Vector2 axis_;
  double area_;
};

/// The common directions of the axes of both bodies. The smaller body has more weight.
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
                      const Vector2& slope) {
  double squared_reach = 0;
  for (int k = 0; k < region.size(); ++k) squared_reach = std::max(squared_reach, region[k].squaredNorm());
  const double reach = std::sqrt(squared_reach);
  const auto [u, v] = common_axes(side1, side2);
  const Vector2 far_u = kLookFrom * reach * u, far_v = kLookFrom * reach * v;
  const std::array<Vector2, 4> nearest =
      region.nearest_to(std::array<Vector2, 4>{far_u + far_v, far_v - far_u, -far_u - far_v, far_u - far_v});
  CornerList corners;
  for (std::size_t k = 0; k < nearest.size(); ++k) {
    corners.points[k] = frame.lift(nearest[k]);
    corners.separations[k] = slope.dot(nearest[k]);
    corners.vertices[0][k] = side1.vertex_at(nearest[k]);
    corners.vertices[1][k] = side2.vertex_at(nearest[k]);
  }
  return corners;
}

}  // namespace

bool may_have_corners(const Shape& shape) { return !shape.traits().is_round && shape.half_extents().minCoeff() >= kMinLength; }

std::optional<CornerList> find_common_corners(const SupportPolygon& polygon1, const SupportPolygon& polygon2, const Vector3& normal,
                                              const Vector3& origin) {
  const bool is_on_edge2 = polygon2.is_long() && !polygon1.is_long();
  const ContactFrame frame{TangentPlane(normal, is_on_edge2 ? polygon2.axis() : polygon1.axis()), origin};
  const double thin = kThinnest * std::min(polygon1.size(), polygon2.size());
  const Side side1(polygon1, frame, false, thin);
  const Side side2(polygon2, frame, true, thin);
  const ConvexPolygon region = common_region(side1.outline(), side2.outline());
  if (region.size() == 0) return std::nullopt;
  const Vector2 slope = frame.plane.project(polygon1.slope() + polygon2.slope());
  return corners_of(region, side1, side2, frame, slope);
}

CornerList corners_over_plane(const SupportPolygon& polygon, const Vector3& normal) {
  CornerList corners;
  for (std::size_t k = 0; k < corners.points.size(); ++k) {
    corners.separations[k] = polygon.slope().dot(polygon.vertices()[k]);
    // On the sloped face, without its rounding. So a body that rolls on a line rolls with the radius of its equator.
    corners.points[k] = polygon.support_point() + polygon.vertices()[k] - std::max(0.0, corners.separations[k]) * normal;
    corners.vertices[0][k] = static_cast<int>(k);
  }
  return corners;
}

}  // namespace supernormal
