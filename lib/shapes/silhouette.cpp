#include "supernormal/shapes/silhouette.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace supernormal {
namespace {

constexpr int kPoints = 48;
constexpr int kRows = 20;  // surface_area() takes kRows x kRows / 2 directions on the upper half

}  // namespace

// The normals are n = D^-1 m with D the half-extents. The m are equidistant, because D^-1 scales the body to equal extents. The
// points D m of an ellipsoid are then the image of a regular polygon, whose fraction of the circle's area is known.
double projected_area(const Shape& shape, const Vector3& direction) {
  const Vector3 extents = shape.half_extents();
  const Vector3 axis = direction.cwiseQuotient(extents).normalized();
  const Vector3 e1 = axis.unitOrthogonal();
  const Vector3 e2 = axis.cross(e1);
  const auto point = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / kPoints;
    return shape.point((std::cos(angle) * e1 + std::sin(angle) * e2).cwiseQuotient(extents).normalized());
  };
  const Vector3 first = point(0);
  Vector3 previous = first;
  Vector3 twice = Vector3::Zero();
  for (int k = 1; k < kPoints; ++k) {
    const Vector3 next = point(k);
    twice += (previous - first).cross(next - first);
    previous = next;
  }
  const double step = 2 * std::numbers::pi / kPoints;
  return 0.5 * std::abs(twice.dot(direction.normalized())) * step / std::sin(step);
}

double surface_area(const Shape& shape) {
  // The midpoint rule in z and around it. Opposite directions have the same projection.
  double sum = 0;
  for (int row = 0; row < kRows / 2; ++row) {
    const double z = 2 * (row + 0.5) / kRows;
    for (int k = 0; k < kRows; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.25) / kRows;
      const double radius = std::sqrt(1 - z * z);
      sum += projected_area(shape, Vector3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  }
  return 4 * sum / (kRows * kRows / 2.0);
}

}  // namespace supernormal
