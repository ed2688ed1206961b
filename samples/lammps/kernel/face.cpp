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

// A normal this near to an axis, as a part of the support function, is at a flat spot of an outline with an exponent above 2. There
// the point that it touches with rotates around the body infinitely fast. So would the share of a side at a border: for an outline
// of the exponent 3.9 it changes by 360 per rad at most; by 60 with ten times the constant, 1600 with a tenth, and at least 11 600,
// in a spike narrower than 1e-5 rad, with 0.
constexpr double kFlatSpot = 0.01;

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

/// The largest tilt at which the body does not touch beside its polygon or line.
double find_largest_tilt(auto is_beside) {
  double low = kSmallestTilt, high = kLargestTilt;
  if (!is_beside(high)) return high;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (is_beside(middle) ? high : low) = middle;
  }
  return low;
}

/// The largest tilt about one direction at which the polygon still reaches as far as the body.
double find_tilt(const supernormal::Superellipsoid& body, const Face& face, const Vector2& direction) {
  double reach = 0;
  for (int k = 0; k < face.count; ++k) reach = std::max(reach, direction.dot(face.vertices.at(static_cast<std::size_t>(k))));
  return find_largest_tilt([&](double tilt) {
    const Vector3 normal = from_face(face.axis, std::sin(tilt) * direction.x(), std::sin(tilt) * direction.y(), std::cos(tilt));
    return body.support(normal) > std::cos(tilt) * face.height + std::sin(tilt) * reach;
  });
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

/// The exponent of the support function.
double dual(double exponent) { return exponent / (exponent - 1); }

/// The largest tilt of a direction across the side at which the line still reaches as far as the body.
double find_tilt(const supernormal::Superellipsoid& body, const Side& side, const Vector3& direction) {
  return find_largest_tilt([&](double tilt) {
    const Vector3 normal = std::cos(tilt) * direction + std::sin(tilt) * Vector3::Unit(side.along);
    return body.support(normal) > side.end(normal, 1).support;
  });
}

/// The direction across a can in which it is thinnest.
Vector3 thinnest(const Side& can) {
  const double ratio = can.half_axes.x() / can.half_axes.y();
  // The least (|a cos|^p + |b sin|^p)^(1/p) is on an axis up to p = 2, and then where both terms change alike.
  const double p = dual(can.delta);
  const double angle = p > 2 ? std::atan(std::pow(ratio, p / (p - 2))) : ratio < 1 ? 0 : std::numbers::pi / 2;
  return {std::cos(angle), std::sin(angle), 0};
}

/// Where the curve spanned by two vectors, c U + s W with |c|^d + |s|^d = 1, reaches farthest along a direction. `u` and `w` are
/// the parts of the vectors along it, from 0 on, and `e` the exponent of the support function.
Side::End farthest_on(const Vector3& to_u, double u, const Vector3& to_w, double w, double e) {
  const double larger = std::max(u, w);
  if (larger == 0) return {0, Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), 0};
  const double power_u = std::pow(u / larger, e), power_w = std::pow(w / larger, e), sum = power_u + power_w;
  const double support = larger * std::pow(sum, 1 / e);
  const double part_u = u / support, part_w = w / support;
  // The part to the power e - 1.
  const double by_u = part_u > 0 ? power_u / (sum * part_u) : 0, by_w = part_w > 0 ? power_w / (sum * part_w) : 0;
  // The same, smooth, and its slope.
  const auto smooth = [e](double part) {
    const double square = part * part, size = square + kFlatSpot * kFlatSpot, power = std::pow(size, 0.5 * e - 2);
    return std::pair(part * size * power, (size + (e - 2) * square) * power);
  };
  const auto [place_u, slope_u] = smooth(part_u);
  const auto [place_w, slope_w] = smooth(part_w);
  return {support,
          by_u * to_u + by_w * to_w,
          place_u * to_u + place_w * to_w,
          (slope_u * by_w * to_u - slope_w * by_u * to_w) / support,
          part_w * to_u - part_u * to_w,
          (e - 1) * std::pow(part_u * part_w, e - 2) / support};
}

}  // namespace

// By Hoelder's inequality it is another norm of (a, b).
double farthest(double a, double b, double e) {
  const double longer = std::max(a, b);
  if (e <= 2) return longer;
  const double power = 2 * e / (e - 2);
  return longer * std::pow(1 + std::pow(std::min(a, b) / longer, power), 1 / power);
}

Side::End Side::end(const Vector3& normal, int sign) const {
  const Vector3 sizes = half_axes.cwiseProduct(normal.cwiseAbs());
  const auto axis = [&](int k) -> Vector3 { return std::copysign(half_axes[k], normal[k]) * Vector3::Unit(k); };
  const Vector3 shift = sign * reach * Vector3::Unit(along);
  if (across == along) {
    End outline = farthest_on(axis(0), sizes.x(), axis(1), sizes.y(), dual(delta));
    outline.support += shift.dot(normal);
    outline.point += shift;
    outline.place += shift;
    return outline;
  }
  // A profile through one edge of the boxy outline.
  const double outwards = std::max(0.0, sizes[across] + shift.dot(normal));
  return farthest_on(axis(across) + shift, outwards, axis(2), sizes.z(), dual(epsilon));
}

double Side::part_across(const Vector3& normal) const {
  return across == along ? normal.head<2>().norm() : std::abs(normal[across]);
}

std::vector<Side> find_sides(const supernormal::Superellipsoid& body) {
  std::vector<Side> sides;
  const Vector3& axes = body.half_axes();
  for (int across = 0; across < 2; ++across) {
    const int beside = 1 - across;
    const Rectangle half = find_rectangle(body, across);
    // Of a can, the curves stick out in proportion to the support function of the outline.
    const double widest = farthest(axes.x(), axes.y(), body.delta()) / axes[across];
    const double aside = across == 0 ? half.x : half.y, up = across == 0 ? half.y : half.x;
    const bool is_flat_aside = aside >= kNarrow * axes[beside], is_flat_up = up >= kNarrow * axes.z();
    if (is_flat_aside == is_flat_up) continue;
    Side side{.along = is_flat_up ? 2 : beside,
              .across = is_flat_up ? 2 : across,
              .reach = is_flat_up ? up : aside,
              .bulge = is_flat_up ? widest * half.bulge : half.bulge,
              .half_axes = axes,
              .delta = body.delta(),
              .epsilon = body.epsilon()};
    if (is_flat_up && !sides.empty()) {
      // The same side from its other direction.
      Side& known = sides.back();
      known.reach = std::min(known.reach, side.reach);
      known.bulge = std::max(known.bulge, side.bulge);
    } else {
      sides.push_back(side);
    }
  }
  for (Side& side : sides) {
    side.tilt = find_tilt(body, side, side.across == side.along ? thinnest(side) : Vector3(Vector3::Unit(side.across)));
  }
  return sides;
}

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
