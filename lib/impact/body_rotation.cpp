#include "impact/body_rotation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "supernormal/shapes/bounding_box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace supernormal {
namespace {

// The axis of a body of revolution in its own frame, through the origin. 0 for a ball, for which every axis is valid.
std::optional<Vector3> axis_of_revolution(const Shape& shape);

std::optional<Vector3> axis_of_ellipsoid(const Vector3& half_axes) {
  if (half_axes.x() == half_axes.y()) return half_axes.y() == half_axes.z() ? Vector3(Vector3::Zero()) : Vector3(Vector3::UnitZ());
  if (half_axes.y() == half_axes.z()) return Vector3(Vector3::UnitX());
  if (half_axes.x() == half_axes.z()) return Vector3(Vector3::UnitY());
  return std::nullopt;
}

bool has_round_section(const auto& shape) { return shape.half_axes().x() == shape.half_axes().y() && shape.delta() == 2; }

std::optional<Vector3> axis_of_revolution(const Shape& shape) {
  const Vector3 z = Vector3::UnitZ();
  if (dynamic_cast<const Sphere*>(&shape) != nullptr) return Vector3(Vector3::Zero());
  if (dynamic_cast<const Capsule*>(&shape) != nullptr || dynamic_cast<const Cylinder*>(&shape) != nullptr) return z;
  if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(&shape)) return axis_of_ellipsoid(ellipsoid->half_axes());
  if (const auto* rounded = dynamic_cast<const Rounded*>(&shape)) return axis_of_revolution(rounded->core());
  if (const auto* surface = dynamic_cast<const Superellipsoid*>(&shape)) {
    if (surface->delta() == 2 && surface->epsilon() == 2) return axis_of_ellipsoid(surface->half_axes());
    return has_round_section(*surface) ? std::optional(z) : std::nullopt;
  }
  const auto* ovoid = dynamic_cast<const Superovoid*>(&shape);
  const bool is_round = ovoid != nullptr && has_round_section(*ovoid) && ovoid->taper_x() == ovoid->taper_y();
  return is_round ? std::optional(z) : std::nullopt;
}

BoundingBox box_of(const Shape& shape) {
  if (!shape.traits().is_symmetric) return find_bounding_box(shape, {});
  const Vector3 half = shape.half_extents();
  return {-half, half};
}

}  // namespace

Matrix3 rotation_at(const Motion& motion, double time) {
  const double speed = motion.angular_velocity.hypotNorm();  // digits of stableNorm() depend on where the vector is in memory
  if (speed == 0) return motion.pose.rotation;
  return Eigen::AngleAxisd(speed * time, motion.angular_velocity / speed).toRotationMatrix() * motion.pose.rotation;
}

Pose pose_at(const Motion& motion, double time) {
  const Matrix3 rotation = rotation_at(motion, time);
  const Vector3 centre = motion.pose.position + motion.pose.rotation * motion.centre + time * motion.velocity;
  return {centre - rotation * motion.centre, rotation};
}

BodyRotation::BodyRotation(const Shape& shape, const Motion& motion) : speed_(motion.angular_velocity.hypotNorm()) {
  if (!is_rotating()) {
    reach_ = shape.half_extents().norm() + motion.centre.norm();
    return;
  }
  axis_ = motion.angular_velocity / speed_;
  const Vector3 axis = motion.pose.rotation.transpose() * axis_;
  const BoundingBox box = box_of(shape);
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 x((corner & 1) != 0 ? box.high.x() : box.low.x(), (corner & 2) != 0 ? box.high.y() : box.low.y(),
                    (corner & 4) != 0 ? box.high.z() : box.low.z());
    reach_ = std::max(reach_, (x - motion.centre).norm());
    axis_distance_ = std::max(axis_distance_, axis.cross(x - motion.centre).norm());
  }
  use_axis(shape, motion);
}

// A body of revolution about the unit vector e consists of the points g + q. Here g is a point of the axis that moves with the
// body. The vector q follows e but does not spin about it. It rotates with w = W - (W.e) e, where W is the angular velocity of the
// body. Since W.e is constant and e' = W x e, w' = -(W.e) W x e. Hence q'' = w' x q + w x (w x q).
void BodyRotation::use_axis(const Shape& shape, const Motion& motion) {
  const std::optional<Vector3> e = axis_of_revolution(shape);
  if (!e) return;
  is_revolved_ = true;
  pivot_distance_ = (*e * e->dot(motion.centre) - motion.centre).norm();
  const Vector3 axis = motion.pose.rotation * *e;
  follow_speed_ = speed_ * axis.cross(axis_).norm();
  follow_acceleration_ = follow_speed_ * speed_ * std::abs(axis.dot(axis_));
}

double BodyRotation::fastest() const {
  const double plain = speed_ * axis_distance_;
  if (!is_revolved_) return plain;
  return std::min(plain, speed_ * pivot_distance_ + follow_speed_ * (reach_ + pivot_distance_));
}

// A point on a circle about the axis has the velocity W x q and the acceleration W x (W x q). The product with n equals the product
// of W x (W x n) with the part of q across the axis.
double BodyRotation::bound(const Vector3& n, double angle, double normal_rate) const {
  if (!is_rotating()) return 0;
  const double across = speed_ * std::min(axis_.cross(n).norm() + angle, 1.0);  // of the angular velocity, to n
  const double circling = speed_ * across;
  const double plain = circling * axis_distance_ + 2 * normal_rate * speed_ * reach_;
  if (!is_revolved_) return plain;
  const double pivot = pivot_distance_ * (circling + 2 * normal_rate * speed_);
  const double following = follow_speed_ * (follow_speed_ + 2 * normal_rate) + follow_acceleration_;
  return std::min(plain, pivot + following * (reach_ + pivot_distance_));
}

}  // namespace supernormal
