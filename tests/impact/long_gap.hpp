// The gap of two moving bodies in long double, with separate code for poses, normals and support functions.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "supernormal/impact/motion.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal::test {

using Long = long double;
using LongVector = Eigen::Matrix<Long, 3, 1>;
using LongMatrix = Eigen::Matrix<Long, 3, 3>;

/// (|x|^p + |y|^p)^(1/p)
inline Long long_norm(Long x, Long y, Long p) {
  const Long larger = std::max(std::abs(x), std::abs(y));
  const Long smaller = std::min(std::abs(x), std::abs(y));
  return larger == 0 ? 0 : larger * std::pow(1 + std::pow(smaller / larger, p), 1 / p);
}

/// The support function by the definition of the body. Throws std::logic_error for a class that it does not know.
inline Long long_support(const Shape& shape, const LongVector& n) {
  if (const auto* sphere = dynamic_cast<const Sphere*>(&shape)) return sphere->radius() * n.norm();
  if (const auto* body = dynamic_cast<const Ellipsoid*>(&shape)) return body->half_axes().cast<Long>().cwiseProduct(n).norm();
  if (const auto* box = dynamic_cast<const Box*>(&shape)) return box->half_lengths().cast<Long>().dot(n.cwiseAbs());
  if (const auto* can = dynamic_cast<const Cylinder*>(&shape)) {
    return can->radius() * std::hypot(n.x(), n.y()) + can->half_length() * std::abs(n.z());
  }
  if (const auto* capsule = dynamic_cast<const Capsule*>(&shape)) {
    return capsule->radius() * n.norm() + capsule->half_length() * std::abs(n.z());
  }
  const auto* body = dynamic_cast<const Superellipsoid*>(&shape);
  if (body == nullptr) throw std::logic_error("no support function in long double for this class of shape");
  const auto dual = [](double exponent) { return Long{exponent} / (Long{exponent} - 1); };
  const LongVector scaled = body->half_axes().cast<Long>().cwiseProduct(n);
  return long_norm(long_norm(scaled.x(), scaled.y(), dual(body->delta())), scaled.z(), dual(body->epsilon()));
}

struct LongPose {
  LongVector position;
  LongMatrix rotation;
};

inline LongPose long_pose_at(const Motion& motion, double time) {
  const LongVector turn = Long{time} * motion.angular_velocity.cast<Long>();
  const Long angle = turn.norm();
  const LongMatrix first = motion.pose.rotation.cast<Long>();
  const LongMatrix rotation = angle == 0 ? first : LongMatrix(Eigen::AngleAxis<Long>(angle, turn / angle) * first);
  const LongVector offset = motion.centre.cast<Long>();
  const LongVector centre = motion.pose.position.cast<Long>() + first * offset + Long{time} * motion.velocity.cast<Long>();
  return {centre - rotation * offset, rotation};
}

/// s(n), m: a lower bound of the gap for any normal from body 1 to body 2, and the gap at the common normal of separate bodies.
inline Long long_gap(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2, double time,
                     const Vector3& normal) {
  const LongPose pose1 = long_pose_at(motion1, time);
  const LongPose pose2 = long_pose_at(motion2, time);
  const LongVector n = normal.cast<Long>().normalized();
  return n.dot(pose2.position - pose1.position) - long_support(shape1, pose1.rotation.transpose() * n) -
         long_support(shape2, -(pose2.rotation.transpose() * n));
}

}  // namespace supernormal::test
