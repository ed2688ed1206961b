#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "contact/manifold/common_corners.hpp"
#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace supernormal {
namespace {

/// The plane of a contact with a face. The origin is the point under the deepest point of the body.
struct Floor {
  Vector3 normal;  // unit, out of the surface
  Vector3 origin;  // m, world frame
  double height;   // m; a triangle farther from the plane than this, plus a crack, is not floor

  bool has(const MeshTriangle& triangle) const {
    const Vector3 a = triangle.vertices[0] - origin;
    const Vector3 b = triangle.vertices[1] - origin;
    const Vector3 c = triangle.vertices[2] - origin;
    const double longest = longest_side(triangle);
    // Of a vertex from the plane. Without the rounding, 155 of 2304 queries on slopes of floats have too few contacts; with one
    // rounding none have, but creases have 4 % fewer.
    const double off = kSeam * longest + 4 * triangle.rounding;
    const double near = height + off;
    if (!(std::abs(normal.dot(a)) <= near && std::abs(normal.dot(b)) <= near && std::abs(normal.dot(c)) <= near)) return false;
    const Vector3 area = (b - a).cross(c - a);
    return area.dot(normal) > 0 && area.cross(normal).norm() <= 2 * off * longest;
  }
};

struct Stretch {
  double from = 0;
  double to = 0;
  double border = 0;  // `to` without the crack
};

/// The part of the segment from the origin to `corner` over the triangle or an adjacent crack, as fractions of the segment. If
/// there is none, from > to.
Stretch stretch_over(const Floor& floor, const MeshTriangle& triangle, const Vector3& corner) {
  Stretch stretch{0, 1, 1};
  const Vector3 to_corner = corner - floor.origin;
  const double crack = kSeam * std::max(to_corner.norm(), longest_side(triangle));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 start = triangle.vertices[k] - floor.origin;
    const Vector3 inward = floor.normal.cross(triangle.vertices[(k + 1) % 3] - triangle.vertices[k]).normalized();
    // The segment's point t to_corner is inside, inward.(t to_corner - start) >= 0, or outside by less than a crack.
    const double slope = inward.dot(to_corner);
    const double offset = inward.dot(start);
    if (slope > 0) {
      stretch.from = std::max(stretch.from, (offset - crack) / slope);
    } else if (slope < 0 && (offset - crack) / slope < stretch.to) {
      stretch.to = (offset - crack) / slope;
      stretch.border = offset / slope;
    } else if (slope == 0 && offset > crack) {
      return {1, 0, 0};
    }
  }
  return stretch;
}

/// How far the floor extends from the origin towards `corner`, as a fraction of the segment.
double fraction_on_floor(const Floor& floor, std::span<const MeshTriangle> triangles, const Vector3& corner) {
  double reached = 0;
  double border = 0;
  bool is_extended = true;
  while (is_extended && reached < 1) {
    is_extended = false;
    for (const MeshTriangle& triangle : triangles) {
      if (!floor.has(triangle)) continue;
      const Stretch stretch = stretch_over(floor, triangle, corner);
      if (stretch.from > reached + kSeam || stretch.to <= reached) continue;
      reached = stretch.to;
      border = std::max(border, stretch.border);
      is_extended = true;
    }
  }
  return reached < 1 ? border : 1;
}

}  // namespace

// Manifold points in the air move in towards the mean of the contact and the points on the floor. The contact itself may be on the
// border, and towards it they would all end there.
void draw_in_corners(ContactManifold& manifold, std::span<const MeshTriangle> triangles) {
  if (manifold.corner_count == 0) return;
  const double depth = -manifold.deepest.gap;
  Floor floor{-manifold.deepest.normal, manifold.deepest.point2, std::max(0.0, depth)};
  std::array<double, ContactManifold::kMaxCorners> fractions{};
  bool is_on_face = false;
  double on_floor = 1;
  ManifoldCorner middle{manifold.deepest.contact, depth};
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    const ManifoldCorner& corner = manifold.corners[k];
    fractions[k] = fraction_on_floor(floor, triangles, corner.point);
    is_on_face = is_on_face || fractions[k] > 0;
    if (fractions[k] < 1) continue;
    ++on_floor;
    middle.point += (corner.point - middle.point) / on_floor;
    middle.depth += (corner.depth - middle.depth) / on_floor;
  }
  if (!is_on_face) {
    manifold.corner_count = 0;
    return;
  }
  floor.origin = middle.point - floor.normal.dot(middle.point - manifold.deepest.point2) * floor.normal;
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    if (fractions[k] >= 1) continue;
    ManifoldCorner& corner = manifold.corners[k];
    const double fraction = fraction_on_floor(floor, triangles, corner.point);
    corner.point = middle.point + fraction * (corner.point - middle.point);
    corner.depth = middle.depth + fraction * (corner.depth - middle.depth);
    put_on_boundary(manifold, corner.point);
  }
}

}  // namespace supernormal
