#include "supernormal/contact_curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

constexpr double kSharpest = 1e-9;    // radius of an edge, relative to the smallest half-extent
constexpr double kFlattest = 1e12;    // radius of a face
constexpr double kDifference = 1e-4;  // rad; boundary points are good to rounding, so the differences to about 1e-8

/// Radii of curvature in the tangent plane t1, t2.
struct Radii {
  double xx, xy, yy;
};

Radii find_radii(const Shape& shape, const Vector3& m, const Vector3& t1, const Vector3& t2) {
  Vector3 H1;
  Vector3 H2;
  if (shape.has_curvature()) {
    const Matrix3 H = shape.jet(m).H;
    H1 = H * t1;
    H2 = H * t2;
  } else {
    const auto slope = [&](const Vector3& t) -> Vector3 {
      const Vector3 forward = shape.point((m + kDifference * t).normalized());
      const Vector3 backward = shape.point((m - kDifference * t).normalized());
      return (forward - backward) / (2 * kDifference);
    };
    H1 = slope(t1);
    H2 = slope(t2);
  }
  return {t1.dot(H1), 0.5 * (t1.dot(H2) + t2.dot(H1)), t2.dot(H2)};
}

/// The eigenvalue of larger magnitude's direction comes first: (cos, sin) of its angle from t1.
struct Principal {
  double larger, smaller, cosine, sine;
};

Principal principal(double xx, double xy, double yy) {
  const double mean = 0.5 * (xx + yy);
  const double half = 0.5 * (xx - yy);
  const double radius = std::hypot(half, xy);
  const double angle = 0.5 * std::atan2(xy, half);
  return {mean + radius, mean - radius, std::cos(angle), std::sin(angle)};
}

}  // namespace

Matrix3 find_curvature(const Shape& shape, const Pose& pose, const Vector3& n) {
  const Vector3 m = pose.rotation.transpose() * n;
  const Vector3 t1 = m.unitOrthogonal();
  const Vector3 t2 = m.cross(t1);
  const double size = shape.half_extents().minCoeff();
  // Scaled, since radii of faces go up to 1e120.
  const Radii radii = find_radii(shape, m, t1, t2);
  const auto bounded = [&](double radius) { return std::clamp(radius / size, -kFlattest, kFlattest); };
  const Principal found = principal(bounded(radii.xx), bounded(radii.xy), bounded(radii.yy));
  const auto curvature = [&](double radius) { return radius < kFlattest / 2 ? 1 / (size * std::max(radius, kSharpest)) : 0.0; };
  const Vector3 first = pose.rotation * (found.cosine * t1 + found.sine * t2);
  const Vector3 second = n.cross(first);
  return curvature(found.larger) * first * first.transpose() + curvature(found.smaller) * second * second.transpose();
}

ContactCurvature find_contact_curvature(const Matrix3& sum, const Vector3& n) {
  const Vector3 t1 = n.unitOrthogonal();
  const Vector3 t2 = n.cross(t1);
  const Principal found = principal(t1.dot(sum * t1), t1.dot(sum * t2), t2.dot(sum * t2));
  return {std::max(0.0, found.smaller), std::max(0.0, found.larger)};
}

}  // namespace supernormal
