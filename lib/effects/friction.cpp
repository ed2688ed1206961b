// Coulomb friction within ODE's contact joint, which limits the two friction forces separately, to a rectangle in the tangent
// plane.
#include <algorithm>
#include <cmath>

#include "effects/motion.hpp"
#include "effects/pair_material.hpp"

namespace supernormal::effects {
namespace {

constexpr double kNoSlip = 1e-150;  // m/s; a slower slip has no direction

/// The slip of a contact after a step without friction. Friction opposes it.
class Slip {
 public:
  explicit Slip(const Patch& patch)
      : body1_(patch.body1), body2_(patch.body2), gain_(patch.step * (acceleration_of(body1_) - acceleration_of(body2_))) {}

  /// m/s; the tangential velocity of body 1 relative to body 2, world frame.
  Vector3 at(const dContact& contact) const {
    const Vector3 point = ode::to_vector(contact.geom.pos);
    const Vector3 n = ode::to_vector(contact.geom.normal);
    const Vector3 velocity = velocity_at(body1_, point) - velocity_at(body2_, point) + gain_;
    return velocity - n.dot(velocity) * n;
  }

 private:
  dBodyID body1_;
  dBodyID body2_;
  Vector3 gain_;
};

/// The half-sides of a rectangle that is inscribed in the unit circle. Its vertex is as near as possible to the direction (x, y),
/// but no half-side is shorter than 0.1. So no direction is left without friction.
struct InscribedRectangle {
  double first, second;

  static InscribedRectangle towards(double x, double y) {
    constexpr double kLeast = 0.1;
    const double length = std::hypot(x, y);
    if (!(length > 1e-150)) return {std::sqrt(0.5), std::sqrt(0.5)};
    const double most = std::sqrt(1 - kLeast * kLeast);
    const double first = std::clamp(std::abs(x) / length, kLeast, most);
    return {first, std::sqrt(1 - first * first)};
  }
};

// Rotates fdir1 by 45 degrees from the slip. Then the vertex of ODE's square of forces opposes the slip.
void align_corner(const Slip& slip, dContact& contact) {
  const Vector3 n = ode::to_vector(contact.geom.normal);
  const Vector3 u = slip.at(contact);
  const double speed = u.norm();
  const Vector3 along = speed > kNoSlip ? Vector3(u / speed) : n.unitOrthogonal();
  // Rounding leaves a component along n, and ODE would take fdir1 for oblique.
  Vector3 first = along + n.cross(along);
  first -= n.dot(first) * n;
  ode::from_vector(first.normalized(), contact.fdir1);
}

/// The direction in the world frame. It is fixed to the body or, without a body, to the geom.
Vector3 world_direction(const FrictionAxes& axes, const Patch& patch) {
  const Vector3& d = axes.direction;
  dVector3 world;
  if (const dBodyID body = axes.is_on_second ? patch.body2 : patch.body1) {
    dBodyVectorToWorld(body, ode::to_real(d.x()), ode::to_real(d.y()), ode::to_real(d.z()), world);
  } else {
    const dGeomID carrier = axes.is_on_second ? patch.geom2() : patch.geom1();
    dGeomVectorToWorld(carrier, ode::to_real(d.x()), ode::to_real(d.y()), ode::to_real(d.z()), world);
  }
  return ode::to_vector(world);
}

void set_ellipse(const FrictionAxes& axes, const Vector3& direction, const Slip& slip, dContact& contact) {
  const Vector3 n = ode::to_vector(contact.geom.normal);
  Vector3 first = direction;
  first -= n.dot(first) * n;
  // If the direction is along the normal, it has no projection onto the surface, and any tangent will do.
  if (first.norm() < 1e-6 * axes.direction.norm()) first = n.unitOrthogonal();
  first.normalize();
  const Vector3 u = slip.at(contact);
  InscribedRectangle half_sides = InscribedRectangle::towards(axes.along * first.dot(u), axes.across * n.cross(first).dot(u));
  if (axes.is_ellipse || axes.along == 0 || axes.across == 0) half_sides = {1, 1};  // without an axis it is a line
  ode::from_vector(first, contact.fdir1);
  contact.surface.mu = ode::to_real(axes.along * half_sides.first);
  contact.surface.mu2 = ode::to_real(axes.across * half_sides.second);
}

}  // namespace

void align_friction(const PairMaterial& /*pair*/, Patch& patch) {
  const Slip slip(patch);
  for (dContact& contact : patch.contacts) align_corner(slip, contact);
}

void align_anisotropic_friction(const PairMaterial& pair, Patch& patch) {
  const Slip slip(patch);
  const Vector3 direction = world_direction(pair.axes, patch);
  for (dContact& contact : patch.contacts) set_ellipse(pair.axes, direction, slip, contact);
}

// The axes are the axes of friction (fdir1, fdir2), and ODE limits the two torques separately too. At rest, the force that pulls
// the bodies along also sets them rolling, about the axis n x slip. `onset` is the angular velocity of this rolling.
void align_rolling(const PairMaterial& pair, Patch& patch) {
  const Slip slip(patch);
  const Vector3 spin = spin_of(patch.body1) - spin_of(patch.body2);
  for (dContact& contact : patch.contacts) {
    if ((contact.surface.mode & dContactFDir1) == 0) {
      align_corner(slip, contact);
      contact.surface.mode |= dContactFDir1;
    }
    if (pair.rolling == 0) continue;
    const Vector3 n = ode::to_vector(contact.geom.normal);
    const Vector3 first = ode::to_vector(contact.fdir1);
    double radius = INFINITY;
    for (const dBodyID body : {patch.body1, patch.body2}) {
      if (body == nullptr || dBodyIsKinematic(body) != 0) continue;  // a kinematic body does not begin to roll
      radius = std::min(radius, (ode::to_vector(contact.geom.pos) - ode::to_vector(dBodyGetPosition(body))).norm());
    }
    const Vector3 onset = radius > 0 && std::isfinite(radius) ? Vector3(n.cross(slip.at(contact)) / radius) : Vector3::Zero();
    const Vector3 angular_velocity = spin + onset;
    const InscribedRectangle half_sides =
        InscribedRectangle::towards(angular_velocity.dot(first), angular_velocity.dot(n.cross(first)));
    contact.surface.rho = ode::to_real(pair.rolling * half_sides.first);
    contact.surface.rho2 = ode::to_real(pair.rolling * half_sides.second);
  }
}

}  // namespace supernormal::effects
