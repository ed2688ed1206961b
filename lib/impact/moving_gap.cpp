#include "impact/moving_gap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal {
namespace {

// Rounding error of s in ulps of its terms: as much as in the gap function (gap_function.cpp), and the same again for the
// positions, which are sums of products with the time.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

const Motion kAtRest;

Vector3 centre_of(const Motion& motion) { return motion.pose.position + motion.pose.rotation * motion.centre; }

}  // namespace

MovingGap::MovingGap(const Motion& motion1, const Motion& motion2, const BodyRotation& rotation1, const BodyRotation& rotation2)
    : motion1_(motion1),
      motion2_(motion2),
      rotation1_(rotation1),
      rotation2_(rotation2),
      centre1_(centre_of(motion1)),
      centre_offset_((motion2.pose.position - motion1.pose.position) + motion2.pose.rotation * motion2.centre -
                     motion1.pose.rotation * motion1.centre),
      velocity_(motion2.velocity - motion1.velocity) {}

double MovingGap::rounding(double t) const { return kRounding * (terms() + t * fastest()); }

double MovingGap::known_until(double rounding, double horizon) const {
  const double displacement = std::max(0.0, rounding / kRounding - terms());
  return displacement < horizon * fastest() ? displacement / fastest() : horizon;
}

double MovingGap::rate(const Proximity& proximity, double t) const {
  // On a face the witness points are not unique. The contact point lies in both bodies.
  const bool has_contact = proximity.status != Status::Apart;
  const Vector3 point1 = has_contact ? proximity.contact : proximity.point1;
  const Vector3 point2 = has_contact ? proximity.contact : proximity.point2;
  const Vector3 by_rotation1 = motion1_.angular_velocity.cross(point1);
  const Vector3 by_rotation2 = motion2_.angular_velocity.cross(point2 - offset(t));
  return proximity.normal.dot(velocity_ + by_rotation2 - by_rotation1);
}

double MovingGap::gap_of_balls(const Proximity& proximity, double t) const {
  const Vector3& n = proximity.normal;
  const double reach1 = rotation1_.is_rotating() ? rotation1_.reach() : n.dot(proximity.point1);
  const double reach2 = rotation2_.is_rotating() ? rotation2_.reach() : n.dot(offset(t) - proximity.point2);
  return n.dot(offset(t)) - reach1 - reach2;
}

MovingPair::MovingPair(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2, Solver solver)
    : MovingGap(motion1, motion2, BodyRotation(shape1, motion1), BodyRotation(shape2, motion2)),
      shape1_(shape1),
      shape2_(shape2),
      solver_(solver),
      length_unit_(GapFunction(shape1, {}, shape2, {}).length_unit()) {}

Pose MovingPair::pose1(double t) const {
  const Matrix3 rotation = rotation_at(motion1(), t);
  return {-(rotation * motion1().centre), rotation};
}

Pose MovingPair::pose2(double t) const {
  const Matrix3 rotation = rotation_at(motion2(), t);
  return {offset(t) - rotation * motion2().centre, rotation};
}

Proximity MovingPair::find(double t, const Vector3* first_normal, double tolerance, int most_evaluations) {
  const Pose one = pose1(t);
  Vector3 start;
  if (first_normal != nullptr) start = one.rotation.transpose() * *first_normal;
  Settings settings;
  settings.solver = solver_;
  // Two points have no size: any tolerance is the largest.
  settings.tolerance = tolerance < length_unit_ ? std::max(tolerance / length_unit_, 1e-15) : 1;
  settings.max_evaluations = most_evaluations;
  Proximity out = find_proximity(shape1_, one, shape2_, pose2(t), settings, first_normal != nullptr ? &start : nullptr);
  count(out.evaluations);
  return out;
}

Proximity MovingPair::evaluate(const Vector3& n, double t) {
  const Pose one = pose1(t);
  GapFunction gap(shape1_, one, shape2_, pose2(t));
  GapJet jet;
  gap.evaluate((one.rotation.transpose() * n).normalized(), Order::Point, jet);
  count(1);
  Proximity out;
  if (!jet.is_finite()) return out;
  out.gap = jet.s;
  out.normal = n;
  out.point1 = one.rotation * jet.jet1.r + one.position;
  out.point2 = out.point1 + one.rotation * jet.d;
  out.contact = 0.5 * (out.point1 + out.point2);
  out.evaluations = 1;
  out.status = Status::Apart;
  out.is_global = false;
  return out;
}

double MovingPair::terms() const { return offset(0).norm() + reach(); }

double MovingPair::balls_meet(double horizon) const {
  if (!is_rotating()) return 0;
  const double radius = reach() + rounding(horizon);
  const double c = offset(0).squaredNorm() - radius * radius;
  const double b = offset(0).dot(velocity());
  if (!(c > 0)) return 0;
  const double a = velocity().squaredNorm();
  const double discriminant = b * b - a * c;
  if (b >= 0 || discriminant < 0) return std::numeric_limits<double>::infinity();
  return c / (-b + std::sqrt(discriminant));
}

bool MovingPair::is_parting(double t) const {
  return is_rotating() && offset(t).dot(velocity()) >= 0 && offset(t).norm() > reach() + rounding(t);
}

MovingOverPlane::MovingOverPlane(const Shape& shape, const Motion& motion, const Vector3& plane_normal, double plane_offset)
    : MovingGap(motion, kAtRest, BodyRotation(shape, motion), BodyRotation(shape, kAtRest)),
      shape_(shape),
      plane_normal_(plane_normal),
      plane_offset_(plane_offset) {}

Proximity MovingOverPlane::find(double t, const Vector3* /*first_normal*/, double /*tolerance*/, int /*most_evaluations*/) {
  const Matrix3 rotation = rotation_at(motion1(), t);
  count(1);
  return find_plane_proximity(shape_, {-(rotation * motion1().centre), rotation}, plane_normal_,
                              plane_offset_ - plane_normal_.dot(origin(t)));
}

double MovingOverPlane::terms() const { return first_centre1().norm() + reach() + std::abs(plane_offset_); }

bool MovingOverPlane::is_parting(double t) const {
  const double height = plane_normal_.dot(origin(t)) - plane_offset_;
  return is_rotating() && plane_normal_.dot(velocity()) <= 0 && height > reach() + rounding(t);
}

}  // namespace supernormal
