// The corners of the region on which two bodies may rest on one another.
#pragma once

#include <array>
#include <optional>

#include "contact/manifold/support_polygon.hpp"
#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

// Corners that are nearer to each other than this share of the body's extent are one; from twice that on they are two, and in
// between they move together.
inline constexpr double kSamePlace = 0.01;

/// Points on which the bodies may rest, and how far the faces lean away from one another there, m.
struct CornerList {
  std::array<Vector3, ContactManifold::kMaxCorners> points;
  std::array<double, ContactManifold::kMaxCorners> leans;
};

/// Whether the body may rest on more than one point. Plates and segments have no thickness to be deep in, nor have shapes that are
/// thinner than a body of ours may be.
bool may_have_corners(const Shape& shape);

/// The corners of what the support polygons of two bodies have in common, counter-clockwise about the normal, which points from
/// body 1 to body 2, in the plane through `origin`; none where the polygons do not meet.
std::optional<CornerList> find_common_corners(const SupportPolygon& polygon1, const SupportPolygon& polygon2, const Vector3& normal,
                                              const Vector3& origin);

/// The corners of a body over a plane; `normal` points from the body to the plane.
CornerList corners_over_plane(const SupportPolygon& polygon, const Vector3& normal);

}  // namespace supernormal
