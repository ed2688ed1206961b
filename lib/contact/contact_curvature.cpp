#include "supernormal/contact/contact_curvature.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/tangent_plane.hpp"
#include "base/validation.hpp"
#include "proximity/gap/limits.hpp"
#include "proximity/lanes/lane_query.hpp"

namespace supernormal {
namespace {

constexpr double kDifference = 1e-4;  // rad; boundary points are exact to rounding, so the differences are good to about 1e-8

/// Estimates the radii of curvature by finite differences of boundary points.
Symmetric2 find_radii(const Shape& shape, const TangentPlane& plane) {
  const auto change = [&](const Vector3& t) {
    const Vector3 forward = shape.point((plane.n + kDifference * t).normalized());
    const Vector3 backward = shape.point((plane.n - kDifference * t).normalized());
    return plane.project((forward - backward) / (2 * kDifference));
  };
  const Vector2 along1 = change(plane.t1), along2 = change(plane.t2);
  return {along1.x(), 0.5 * (along1.y() + along2.x()), along2.y()};
}

}  // namespace

Matrix3 find_curvature(const Shape& shape, const Pose& pose, const Vector3& n) {
  const Vector3 m = pose.rotation.transpose() * n;
  const Matrix3 H = shape.traits().has_hessian ? shape.jet(m).H : Matrix3(Matrix3::Zero());
  const TangentPlane plane = TangentPlane::along_flattest(m, H);
  const Eigen2 radii(shape.traits().has_hessian ? Symmetric2::project(plane, H) : find_radii(shape, plane));
  const double size = shape.half_extents().minCoeff();
  const auto curvature = [&](double radius) {
    return radius < limits::kFlat * size ? 1 / std::max(radius, limits::kSharpest * size) : 0.0;
  };
  const Vector3 first = pose.rotation * plane.lift(radii.high_vector);
  const Vector3 second = pose.rotation * plane.lift(radii.low_vector);
  return curvature(radii.high) * first * first.transpose() + curvature(radii.low) * second * second.transpose();
}

ContactCurvature find_contact_curvature(const Matrix3& sum, const Vector3& n) {
  const TangentPlane plane(n, n.unitOrthogonal());
  const Eigen2 curvature(Symmetric2::project(plane, sum));
  return {std::max(0.0, curvature.low), std::max(0.0, curvature.high)};
}

void find_proximities(std::span<const ProximityQuery> queries, const Settings& settings, std::span<Proximity> results,
                      std::span<ContactCurvature> curvatures) {
  require_one_for_each("curvatures", curvatures.size(), queries.size());
  find_in_lanes(queries, settings, results, curvatures);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (curvatures[k].larger != kUnknownCurvature) continue;
    const Proximity& found = results[k];
    const ProximityQuery& query = queries[k];
    const bool overlap = found.status != Status::InvalidInput && found.gap < 0;
    curvatures[k] = overlap ? find_contact_curvature(find_curvature(*query.shape1, *query.pose1, found.normal) +
                                                         find_curvature(*query.shape2, *query.pose2, -found.normal),
                                                     found.normal)
                            : ContactCurvature();
  }
}

}  // namespace supernormal
