// The manifold points of two bodies: the corners of the region on which they may rest.
#pragma once

#include <array>
#include <optional>

#include "contact/manifold/support_polygon.hpp"
#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

// Manifold points nearer to each other than this fraction of the body's extent become one. From twice this distance on they are
// separate. In between they move together.
inline constexpr double kSamePlace = 0.01;

// ContactManifold::shallow of points with gaps, as a fraction of same_place: at rest their gaps are rounding.
inline constexpr double kShallow = 0.1;

/// Points on which the bodies may rest, and the separation of the two tilted faces there, m.
struct CornerList {
  /// The vertex of the support polygon of each body at each point; -1 at a point that is no vertex.
  using Vertices = std::array<int, ContactManifold::kMaxCorners>;

  std::array<Vector3, ContactManifold::kMaxCorners> points;
  std::array<double, ContactManifold::kMaxCorners> separations;
  std::array<Vertices, 2> vertices;
};

/// Whether the body may rest on more than one point. Plates and segments have no thickness to overlap in. Nor have shapes thinner
/// than the valid range.
bool may_have_corners(const Shape& shape);

/// The corners of the intersection of two support polygons, counter-clockwise about the normal, in the plane through `origin`. The
/// normal points from body 1 to body 2. Empty if the polygons do not intersect.
std::optional<CornerList> find_common_corners(const SupportPolygon& polygon1, const SupportPolygon& polygon2, const Vector3& normal,
                                              const Vector3& origin);

/// The corners of a body over a plane; `normal` points from the body to the plane.
CornerList corners_over_plane(const SupportPolygon& polygon, const Vector3& normal);

/// What becomes of a point beside the silhouette of the body on which it is placed.
enum class Beside { Stays, MovesToSilhouette };

/// Moves a point along the normal to the boundary of manifold.placed_on, if it is placed on a body. Adds to the evaluations of the
/// manifold.
void put_on_boundary(ContactManifold& manifold, Vector3& point, Beside beside = Beside::MovesToSilhouette);

}  // namespace supernormal
