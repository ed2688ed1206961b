#include "method.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace literature {
namespace {

Superquadric superquadric_of(const supernormal::Shape& shape) {
  const auto body = Superquadric::of(shape);
  if (!body) throw std::invalid_argument("the methods of the literature take superellipsoids and ellipsoids only");
  return *body;
}

}  // namespace

Bodies::Bodies(const supernormal::Shape& first, const supernormal::Pose& pose1, const supernormal::Shape& second,
               const supernormal::Pose& pose2)
    : body1(superquadric_of(first)),
      body2(superquadric_of(second)),
      shape1(&first),
      shape2(&second),
      rotation(pose1.rotation.transpose() * pose2.rotation),
      offset(pose1.rotation.transpose() * (pose2.position - pose1.position)) {}

double Bodies::size() const { return std::min(body1.half_axes.minCoeff(), body2.half_axes.minCoeff()); }

const std::vector<NamedMethod>& methods() {
  static const std::vector<NamedMethod> all = {{"implicit points (1)", common_normal_points},
                                               {"surface angles (2)", common_normal_angles},
                                               {"normal angles (2)", normal_angles},
                                               {"midway point (3)", midway_point},
                                               {"contact space: fixed point (4)", contact_space_fixed_point},
                                               {"contact space: distance (4)", contact_space_distance},
                                               {"contact space: common normal (4)", contact_space_common_normal}};
  return all;
}

CommonNormal judged(const Bodies& bodies, const Vector3& point1, const Vector3& normal1, const Vector3& point2,
                    const Vector3& normal2, double accuracy, int evaluations) {
  CommonNormal result;
  result.normal = normal1.normalized();
  result.point1 = point1;
  result.point2 = point2;
  result.gap = result.normal.dot(point2 - point1);
  result.evaluations = evaluations;
  const bool is_touching = std::abs(result.gap) <= accuracy;
  const bool is_inside = bodies.body1.value(point2) < 0;
  const bool is_candidate = std::isfinite(result.gap) && normal1.dot(normal2) < 0 && (is_touching || (result.gap < 0) == is_inside);
  if (is_candidate) result.outcome = Outcome::Found;
  return result;
}

}  // namespace literature
