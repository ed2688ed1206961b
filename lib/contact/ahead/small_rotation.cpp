#include "contact/ahead/small_rotation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/tangent_plane.hpp"
#include "contact/ahead/motion_in_step.hpp"
#include "contact/manifold/common_corners.hpp"
#include "contact/manifold/convex_polygon.hpp"
#include "supernormal/contact/body_box.hpp"

namespace supernormal {
namespace {

// Largest rotation of a body by an impact, rad. The manifold points cover such rotations (manifold/support_polygon.cpp). It
// is smaller if the middle of the body is farther from the centre of mass than the body is thick. Then the rotation moves the
// middle by at most this fraction of the thickness.
constexpr double kLargestRotation = 0.1;

// From this distance of the middle from the centre of mass on, in half-extents of the body's thinnest side, friction has a shorter
// lever arm. Its rotation would swing the middle into the wall.
constexpr double kCentred = 0.125;

// At this multiple of the largest rotation the lever arm has its limit. Below it the arm is interpolated, so no force jumps.
constexpr double kFarTooLarge = 2;

/// The point of the contact region that is nearest to `point`, a point of the tangent plane.
Vector3 nearest_place(const ContactManifold& manifold, const Vector3& point) {
  if (manifold.corner_count == 0) return manifold.deepest.contact;
  const ContactFrame frame{TangentPlane::at(manifold.deepest.normal), point};
  ConvexPolygon region;
  for (int k = 0; k < manifold.corner_count; ++k) region.add(frame.project(manifold.corners[static_cast<std::size_t>(k)].point));
  bool is_inside = region.area() > 0;
  for (int k = 0; k < region.size(); ++k) is_inside = is_inside && cross(region[k], region[(k + 1) % region.size()]) >= 0;
  return is_inside ? point : frame.lift(region.nearest_to({0, 0}));
}

/// The centre of the body's box, m.
Vector3 middle_of(const BodyAhead& body) {
  if (body.shape.traits().is_symmetric) return body.pose.position;
  return body.pose.position + body.pose.rotation * BodyBox::of(body.shape).centre;
}

/// The velocity of the point of the body at `place`, m/s.
Vector3 velocity_at(const BodyAhead& body, const Vector3& place) {
  return body.motion.velocity + body.motion.angular_velocity.cross(place - body.pose.position);
}

/// The distance of the middle of a body that forces move from its centre of mass, in half-extents of its thinnest side.
double eccentricity_of(const BodyAhead& body) {
  if (!(body.motion.mobility > 0)) return 0;
  return (middle_of(body) - body.motion.centre).norm() / body.shape.half_extents().minCoeff();
}

/// The largest rotation of a body by an impact, rad.
double largest_rotation_of(const BodyAhead& body) { return kLargestRotation / std::max(1.0, eccentricity_of(body)); }

/// The squared radius of gyration about the axis of a force with this lever arm, m^2; 0 for a body of infinite inertia.
double squared_gyration(double lever, double torque_turning) { return torque_turning > 0 ? lever * lever / torque_turning : 0; }

/// Limits the lever arm of a contact that stops two bodies.
class LeverLimit {
 public:
  LeverLimit(const BodyAhead& body1, const BodyAhead& body2, double time, double share, const Proximity& contact)
      : normal_(contact.normal),
        centre_(share * body1.motion.centre + (1 - share) * body2.motion.centre),
        turning_(share * body1.motion.turning + (1 - share) * body2.motion.turning),
        rotation_(time * (share * body1.motion.angular_velocity - (1 - share) * body2.motion.angular_velocity)),
        largest_rotation_(share * largest_rotation_of(body1) + (1 - share) * largest_rotation_of(body2)),
        is_eccentric_(std::max(eccentricity_of(body1), eccentricity_of(body2)) > kCentred),
        height_(std::max(0.0, share * normal_.dot(contact.contact - middle_of(body1)) -
                                  (1 - share) * normal_.dot(contact.contact - middle_of(body2)) + std::min(0.0, contact.gap))) {
    const Vector3 under = under_centre(contact.contact);
    const Vector3 closed = time * (velocity_at(body1, under) - velocity_at(body2, under));
    const Vector3 slip = closed - normal_.dot(closed) * normal_;
    slip_ = slip.norm();
    along_ = slip.normalized();
    const double impact = normal_.dot(closed) - std::max(0.0, contact.gap);
    impact_ = std::max(0.0, impact);
    approach_ = impact + time * gained_speed(body1.motion, body2.motion, time);
    const Vector3 torque = (under - centre_).cross(along_);
    const Vector3 axis = turning_ * torque;
    by_friction_ = axis.norm() * std::min(impact_, slip_ / (1 + torque.dot(axis)));
  }

  /// The overlap that would form under the centre of mass without contact forces, m.
  double approach() const { return approach_; }

  /// Whether the middle of a body is off its centre of mass.
  bool is_eccentric() const { return is_eccentric_; }

  /// The point of the tangent plane through `place` on the normal through the centre of mass.
  Vector3 under_centre(const Vector3& place) const { return centre_ + normal_.dot(place - centre_) * normal_; }

  /// The fraction of its lever arm that a contact at `place` keeps.
  double fraction_at(const Vector3& place) const {
    const Vector3 arm = place - under_centre(place);
    return std::min(fraction_for_small_rotation(arm, normal_, approach_), fraction_for_height(arm));
  }

  /// The shift of a contact at `place` in the tangent plane, m.
  Vector3 shift_of(const Vector3& place) const { return (fraction_at(place) - 1) * (place - under_centre(place)); }

  /// The shift along the normal of a body whose middle is off its centre of mass, m.
  Vector3 shift_for_friction(const Vector3& place) const {
    const double displacement = std::min(slip_, impact_);
    if (!(is_eccentric_ && displacement > 0)) return Vector3::Zero();
    const Vector3 arm = under_centre(place) - centre_;
    return (fraction_for_small_rotation(arm, along_, displacement) - 1) * arm;
  }

 private:
  /// The largest fraction of a lever arm with which a force against `direction`, which stops the displacement `displacement` (m),
  /// rotates the bodies by at most the largest rotation. The removal of a present rotation is free.
  double fraction_for_small_rotation(const Vector3& arm, const Vector3& direction, double displacement) const {
    const Vector3 torque = arm.cross(direction);
    const Vector3 axis = turning_ * torque;
    const double lever = arm.norm();
    const double gyration = squared_gyration(lever, torque.dot(axis));
    if (!(gyration > 0)) return 1;
    const double largest = largest_rotation_ + std::max(0.0, rotation_.dot(axis.normalized()));
    // An arm beyond the radius of gyration rotates the body by less. But the shorter arms between it and the limit rotate it by
    // more.
    const double worst = std::min(lever, std::sqrt(gyration));
    const double excess = displacement * worst / (worst * worst + gyration) / largest;
    if (!(excess > 1)) return 1;
    const double twice = 2 * largest * std::sqrt(gyration);
    const double root = std::sqrt(std::max(0.0, displacement * displacement - twice * twice));
    const double small = std::min(lever, 2 * largest * gyration / (displacement + root));
    return 1 - std::min(1.0, (excess - 1) / (kFarTooLarge - 1)) * (1 - small / lever);
  }

  /// The largest fraction of a lever arm b with which the bodies approach by no more than the height H. The impact contributes, and
  /// the rotation u at present and by friction: (A b^2 + u b k^2) / (b^2 + k^2) <= H with the approach A and the radius of gyration
  /// k.
  double fraction_for_height(const Vector3& arm) const {
    const Vector3 torque = arm.cross(normal_);
    const double lever = arm.norm();
    const double gyration = squared_gyration(lever, torque.dot(turning_ * torque));
    const double of_rotation = (rotation_.norm() + by_friction_) * gyration;
    const double discriminant = of_rotation * of_rotation + 4 * (approach_ - height_) * height_ * gyration;
    if (!(discriminant >= 0)) return 1;
    const double allowed = 2 * height_ * gyration;
    const double asked = lever * (of_rotation + std::sqrt(discriminant));
    return allowed < asked ? allowed / asked : 1;
  }

  Vector3 normal_;           // unit, from body 1 to body 2
  Vector3 centre_;           // m; centre of mass
  Matrix3 turning_;          // 1/m^2
  Vector3 rotation_;         // rad; by the present angular velocity
  double largest_rotation_;  // rad; limit for an impact
  bool is_eccentric_;
  double height_;    // m; limit for the approach of the middles, neither beyond the plane
  double slip_;      // m; along the plane, under the centre of mass
  Vector3 along_;    // unit; of the slip, 0 without one
  double impact_;    // m; the approach that an impact stops. The weight rolls the body in steps of any length
  double approach_;  // m; with the weight
  // rad; by friction, which is at most as large as the force of the impact, and ends when sliding ends. Its lever arm is the height
  // of the centre of mass over the contact plane.
  double by_friction_;
};

/// The larger rotation that a contact gives one of two free bodies, in units of its limit. The contact stops `approach` (m).
double excess_of(const BodyAhead& body1, const BodyAhead& body2, double share, double approach, const Proximity& contact) {
  const Vector3 torque1 = (contact.contact - body1.motion.centre).cross(contact.normal);
  const Vector3 torque2 = (contact.contact - body2.motion.centre).cross(contact.normal);
  const Vector3 axis1 = share * (body1.motion.turning * torque1);
  const Vector3 axis2 = (1 - share) * (body2.motion.turning * torque2);
  const double rotation = std::max(axis1.norm() / largest_rotation_of(body1), axis2.norm() / largest_rotation_of(body2));
  return approach * rotation / (1 + torque1.dot(axis1) + torque2.dot(axis2));
}

}  // namespace

void act_between_centres(const BodyAhead& body1, const BodyAhead& body2, double time, double share, double meeting_time,
                         ContactManifold& manifold) {
  Proximity& contact = manifold.deepest;
  const Vector3 velocity = body1.motion.velocity - body2.motion.velocity;
  const double closed = contact.normal.dot(velocity);
  const double excess = excess_of(body1, body2, share, closed * time - std::max(0.0, contact.gap), contact);
  const Vector3 between = (body2.motion.centre - body1.motion.centre).stableNormalized();
  if (!(excess > 1 && between.dot(velocity) > 0)) return;
  const double part = std::min(1.0, (excess - 1) / (kFarTooLarge - 1));
  const Vector3 normal = (contact.normal + part * (between - contact.normal)).stableNormalized();
  const Vector3 place = share * body1.motion.centre + (1 - share) * body2.motion.centre;
  // The gap at the impact, plus the displacement along the new normal until then.
  const double gap = contact.gap + meeting_time * (normal.dot(velocity) - closed);
  contact.gap = std::max(gap, std::min(0.0, contact.gap));
  contact.contact += part * (place - contact.contact);
  contact.normal = normal;
  manifold.corner_count = 0;
}

void limit_rotation(const BodyAhead& body1, const BodyAhead& body2, double time, double share, ContactManifold& manifold) {
  const LeverLimit limit(body1, body2, time, share, manifold.deepest);
  if (!(limit.approach() > 0)) return;
  const auto move = [&](Vector3& point, const Vector3& shift) {
    point += shift;
    // The centre of mass may be beside the body. The silhouette is then farther from it than the limit allows.
    if (!shift.isZero(0)) put_on_boundary(manifold, point, limit.is_eccentric() ? Beside::Stays : Beside::MovesToSilhouette);
    point += limit.shift_for_friction(point);
  };
  Vector3& contact = manifold.deepest.contact;
  const Vector3 under = limit.under_centre(contact);
  const Vector3 place = nearest_place(manifold, under);
  // If all contacts are on one side of the centre, only the nearest one acts. Quickstep does not find this.
  if (manifold.corner_count > 0 && place != under && limit.fraction_at(place) < 1) {
    manifold.corner_count = 0;
    contact = place;
  }
  const Vector3 shift = limit.shift_of(place);
  for (int k = 0; k < manifold.corner_count; ++k) move(manifold.corners[static_cast<std::size_t>(k)].point, shift);
  move(contact, limit.shift_of(contact));  // used alone if max_contacts is 1
}

}  // namespace supernormal
