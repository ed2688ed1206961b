#include "collider_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace supernormal::test {
namespace {

/// The signed distance from {|coordinate| <= half-length}, from the excess of each coordinate.
template <typename Excess>
double signed_distance(const Excess& excess) {
  return excess.cwiseMax(0).norm() + std::min(excess.maxCoeff(), 0.0);
}

double distance_from_segment(const Vector3& a, const Vector3& b, const Vector3& x) {
  const double share = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - share * (b - a)).norm();
}

}  // namespace

double distance_from_box(const Vector3& half_lengths, const Vector3& x) {
  return signed_distance(Vector3(x.cwiseAbs() - half_lengths));
}

double distance_from_capsule(double radius, double half_length, const Vector3& x) {
  return Vector3(x.x(), x.y(), std::max(std::abs(x.z()) - half_length, 0.0)).norm() - radius;
}

double distance_from_cylinder(double radius, double half_length, const Vector3& x) {
  return signed_distance(Eigen::Vector2d(std::hypot(x.x(), x.y()) - radius, std::abs(x.z()) - half_length));
}

double distance_from_simplex(std::span<const Vector3> vertices, const Vector3& x) {
  if (vertices.size() == 1) return (x - vertices[0]).norm();
  if (vertices.size() == 2) return distance_from_segment(vertices[0], vertices[1], x);
  const Vector3 normal = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]).normalized();
  bool is_above_inside = true;
  double from_sides = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3& a = vertices[k];
    const Vector3& b = vertices[(k + 1) % 3];
    is_above_inside = is_above_inside && normal.cross(b - a).dot(x - a) >= 0;
    from_sides = std::min(from_sides, distance_from_segment(a, b, x));
  }
  return is_above_inside ? std::abs(normal.dot(x - vertices[0])) : from_sides;
}

double distance_from_extreme_part(const Collider& collider, const Vector3& n, const Vector3& x, double tolerance) {
  const Vector3& lengths = collider.lengths;
  switch (collider.kind) {
    case ColliderKind::Box:
      return distance_from_box(lengths, x);
    case ColliderKind::Capsule:
      return distance_from_capsule(lengths.x(), lengths.y(), x);
    case ColliderKind::Cylinder:
      return distance_from_cylinder(lengths.x(), lengths.y(), x);
    case ColliderKind::Triangle:
    case ColliderKind::Hull:
      break;
  }
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vector3& point : collider.points) highest = std::max(highest, n.dot(point));
  std::vector<Vector3> extreme;
  for (const Vector3& point : collider.points) {
    if (n.dot(point) >= highest - tolerance) extreme.push_back(point);
  }
  return extreme.size() <= 3 ? distance_from_simplex(extreme, x) : std::numeric_limits<double>::infinity();
}

}  // namespace supernormal::test
