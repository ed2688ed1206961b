#include "kernel/face.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/plane.hpp"

namespace granular {
namespace {

// The overlap with the plane in which the polygon is found, as a fraction of the half-axis: only rounding must be smaller. A
// quarter and four times: all tests of faces hold.
constexpr double kTouch = 1e-9;

// A polygon narrower than this fraction of the body is a line or a point, as in lib/contact/manifold (kSamePlace). A quarter and
// four times: all tests of faces hold. With 0, round bodies have faces.
constexpr double kNarrow = 0.01;

// A square outline with exponents below this has round sides, and its polygon gets vertices on both axes, too. The core counts
// bodies as flat from this exponent on. With a quarter, the end of a can has four vertices; with four times, vertices stick out by
// 0.02 % more than their bulge.
constexpr double kRoundOutline = 6;

// rad; the largest tilt of a face. From twice this on the next face is nearer, for a cube. A quarter and four times: all tests of
// faces hold, and a wall and a gas of bricks are the same.
constexpr double kLargestTilt = std::numbers::pi / 8;
constexpr double kSmallestTilt = 1e-6;  // rad

Vector3 from_face(int axis, double x, double y, double height) {
  Vector3 point;
  point[axis] = height;
  point[(axis + 1) % 3] = x;
  point[(axis + 2) % 3] = y;
  return point;
}

/// The half-extents of the polygon at the end of an axis, m, and its bulge.
struct Rectangle {
  double x = 0, y = 0, bulge = 0;
};

Rectangle find_rectangle(const supernormal::Superellipsoid& body, int axis) {
  const double height = body.half_axes()[axis];
  const Vector3 up = -Vector3::Unit(axis);
  const supernormal::Proximity touch = supernormal::find_plane_proximity(body, {}, up, -(1 - kTouch) * height);
  const supernormal::ContactManifold manifold = supernormal::find_plane_contact_manifold(body, {}, touch);
  Rectangle found;
  for (int k = 0; k < manifold.corner_count; ++k) {
    const Vector3& corner = manifold.corners.at(static_cast<std::size_t>(k)).point;
    found.x = std::max(found.x, std::abs(corner[(axis + 1) % 3]));
    found.y = std::max(found.y, std::abs(corner[(axis + 2) % 3]));
  }
  found.bulge = manifold.margin;
  return found;
}

void add_vertices(const Rectangle& half, double exponent, Face& face) {
  const auto add = [&](double x, double y) { face.vertices.at(static_cast<std::size_t>(face.count++)) = {x, y}; };
  const bool is_round = exponent < kRoundOutline;
  const double stretch = is_round ? std::pow(2, 1 / exponent) : 1;  // |x|^e + |y|^e of the corner
  for (const auto& [x, y] : {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
    if (is_round) add(stretch * x * half.x, stretch * y * half.y);
    add((x - y) * half.x, (x + y) * half.y);
  }
  face.width = 2 * stretch * std::min(half.x, half.y);
}

/// The largest tilt about one direction at which the polygon still reaches as far as the body.
double find_tilt(const supernormal::Superellipsoid& body, const Face& face, const Vector2& direction) {
  double reach = 0;
  for (int k = 0; k < face.count; ++k) reach = std::max(reach, direction.dot(face.vertices.at(static_cast<std::size_t>(k))));
  const auto is_beside = [&](double tilt) {
    const Vector3 normal = from_face(face.axis, std::sin(tilt) * direction.x(), std::sin(tilt) * direction.y(), std::cos(tilt));
    return body.support(normal) > std::cos(tilt) * face.height + std::sin(tilt) * reach;
  };
  double low = kSmallestTilt, high = kLargestTilt;
  if (!is_beside(high)) return high;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (is_beside(middle) ? high : low) = middle;
  }
  return low;
}

/// The least tilt, about the vertices and the sides of a quadrant.
double find_tilt(const supernormal::Superellipsoid& body, const Face& face) {
  double least = kLargestTilt;
  for (std::size_t k = 0; 4 * k <= static_cast<std::size_t>(face.count); ++k) {
    const Vector2& vertex = face.vertices.at(k);
    const Vector2 side = face.vertices.at(k + 1) - vertex;
    least = std::min(
        {least, find_tilt(body, face, vertex.normalized()), find_tilt(body, face, Vector2(side.y(), -side.x()).normalized())});
  }
  return least;
}

}  // namespace

std::vector<Face> find_faces(const supernormal::Superellipsoid& body) {
  std::vector<Face> faces;
  for (int axis = 0; axis < 3; ++axis) {
    const Rectangle half = find_rectangle(body, axis);
    const Vector3& axes = body.half_axes();
    if (half.x < kNarrow * axes[(axis + 1) % 3] || half.y < kNarrow * axes[(axis + 2) % 3]) continue;
    Face face;
    face.axis = axis;
    face.height = axes[axis];
    face.bulge = half.bulge;
    add_vertices(half, axis == 2 ? body.delta() : std::max(body.delta(), body.epsilon()), face);
    face.tilt = find_tilt(body, face);
    faces.push_back(face);
  }
  return faces;
}

FacePose::FacePose(const Face& end, int sign, const supernormal::Pose& pose) : face(&end) {
  const Matrix3& axes = pose.rotation;
  // The polygon is symmetric, so the reflected axis does not change it.
  frame.col(0) = axes.col((end.axis + 1) % 3);
  frame.col(1) = sign * axes.col((end.axis + 2) % 3);
  frame.col(2) = sign * axes.col(end.axis);
  centre = pose.position + end.height * frame.col(2);
}

}  // namespace granular
