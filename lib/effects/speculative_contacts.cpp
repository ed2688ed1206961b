// Contacts ahead of touch as rows of ODE's solver.
//
// A row demands a separating velocity of at least u after the step. With u = -gap / step the gap may close in the step, and no more
// (Anitescu and Potra 1997). ODE's own restitution would add u to e times the approach velocity, and throw the body back by a
// mixture of both. So a pair that will bounce within the step is moved until it touches, before the step. The row then demands the
// velocity with which the bodies leave.
//
// ODE adds forces to velocities and then moves bodies with the new velocities. So its steps lie on a parabola with the velocity
// v + a h / 2 where ODE has v. With the velocities of the parabola, a ball on a plane bounces to e^2 times its height at any step.
#include "effects/speculative_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "effects/motion.hpp"
#include "ode/geom/body.hpp"

namespace supernormal::effects {
namespace {

// Relative to the smallest half-extent: the depth that a body may reach that bounces elsewhere in the same step. Its middle stays
// outside.
constexpr double kShallow = 0.5;

/// The relative motion of two points along the normal of a contact.
struct Separation {
  double gap;           // m
  double velocity;      // m/s, as ODE has it
  double acceleration;  // m/s^2

  /// The contact is placed after the displacements (m); the bodies themselves have not moved yet.
  static Separation at(const dContact& contact, const Patch& patch, const Vector3& displacement1, const Vector3& displacement2) {
    const Vector3 n = ode::to_vector(contact.geom.normal);
    const Vector3 point = ode::to_vector(contact.geom.pos);
    return {-double{contact.geom.depth},
            n.dot(velocity_at(patch.body1, point - displacement1) - velocity_at(patch.body2, point - displacement2)),
            n.dot(acceleration_of(patch.body1) - acceleration_of(patch.body2))};
  }
};

/// The first touch within a step.
struct Touch {
  double time;   // s, from the start of the step
  double speed;  // m/s; approach velocity at touch
};

std::optional<Touch> find_touch(const Separation& separation, double step) {
  const double rate = separation.velocity + separation.acceleration * step / 2;
  const double square = rate * rate - 2 * separation.acceleration * separation.gap;
  if (!(square >= 0)) return std::nullopt;
  const double speed = std::sqrt(square);
  const double closing = speed - rate;
  if (!(2 * separation.gap <= step * closing)) return std::nullopt;
  return Touch{2 * separation.gap / closing, speed};
}

/// A bounce within the step.
struct Bounce {
  double time;      // s, until touch
  double approach;  // m/s; ODE's approach velocity at the start of the step
  double velocity;  // m/s; ODE's separating velocity, if the points touch at the start of the step
};

/// Empty if the points do not touch within the step, approach below the threshold, or would touch again.
std::optional<Bounce> find_bounce(const PairMaterial& pair, const Separation& separation, double step) {
  const std::optional<Touch> touch = find_touch(separation, step);
  if (!touch || !(touch->speed > pair.threshold) || !(separation.velocity < 0)) return std::nullopt;
  const double velocity = pair.restitution * touch->speed + separation.acceleration * step / 2;
  if (!(velocity > 0)) return std::nullopt;
  return Bounce{touch->time, -separation.velocity, velocity};
}

/// Gives the contact its velocity by ODE's restitution, because dWorldSetContactMaxCorrectingVel does not limit restitution.
void let_leave(dContact& contact, const Bounce& bounce) {
  contact.surface.mode |= dContactBounce;
  contact.surface.bounce = ode::to_real(bounce.velocity / bounce.approach);
  contact.surface.bounce_vel = 0;
  contact.geom.depth = 0;
}

/// m; of our geoms in the pair.
double least_half_extent(const Patch& patch) {
  double least = std::numeric_limits<double>::infinity();
  for (const dGeomID geom : {patch.geom1(), patch.geom2()}) {
    if (const ode::Body* const ours = ode::find_body(geom)) least = std::min(least, ours->size());
  }
  return least;
}

void let_close(dContact& contact, double gap, double step) {
  contact.surface.mode |= dContactMotionN;
  contact.surface.motionN = ode::to_real(-gap / step);
  contact.geom.depth = 0;
}

/// 1/kg; 0 for a wall or a kinematic body.
double inverse_mass(dBodyID body) {
  if (body == nullptr || dBodyIsKinematic(body) != 0) return 0;
  dMass mass;
  dBodyGetMass(body, &mass);
  return 1 / double{mass.mass};
}

/// Whether a joint corrects where its bodies are. A contact allows more distance; an angular motor and a ball joint with ERP 0 tie
/// velocities only, as the images of periodic grains.
bool holds_place(dJointID joint) {
  if (dJointIsEnabled(joint) == 0) return false;
  const dJointType type = dJointGetType(joint);
  if (type == dJointTypeBall) return dJointGetBallParam(joint, dParamERP) > 0;
  return type != dJointTypeContact && type != dJointTypeAMotor;
}

/// Whether a joint holds the body in place. Moved alone, it would violate the joint.
bool is_attached(dBodyID body) {
  if (body == nullptr) return false;
  for (int k = 0; k < dBodyGetNumJoints(body); ++k) {
    if (holds_place(dBodyGetJoint(body, k))) return true;
  }
  return false;
}

}  // namespace

/// Plans the displacements of both bodies until `first` touches, `time` (s) from now, and moves the contacts with them. Returns
/// zero displacements if one of the bodies has a planned one or is attached to others, or if neither can move.
SpeculativeSetup::Displacements SpeculativeSetup::bring_to_touch(const dContact& first, double time, Patch& ahead) {
  const double inverse1 = inverse_mass(ahead.body1);
  const double inverse2 = inverse_mass(ahead.body2);
  if (!is_free(ahead.body1) || !is_free(ahead.body2) || !(inverse1 + inverse2 > 0)) return {};
  if (is_attached(ahead.body1) || is_attached(ahead.body2)) return {};
  const Vector3 n = ode::to_vector(first.geom.normal);
  Vector3 displacement = double{first.geom.depth} * n;
  if (inverse1 > 0 && inverse2 > 0) {
    // The contact has one point for both bodies. Its lever arms are right for both only where the bodies touch.
    const Vector3 velocity = ode::to_vector(dBodyGetLinearVel(ahead.body1)) - ode::to_vector(dBodyGetLinearVel(ahead.body2));
    displacement += time * (velocity - n.dot(velocity) * n);
  }
  const Displacements displacements = {inverse1 / (inverse1 + inverse2) * displacement,
                                       -inverse2 / (inverse1 + inverse2) * displacement};
  if (inverse1 > 0) plan(ahead.body1, displacements.first);
  if (inverse2 > 0) plan(ahead.body2, displacements.second);
  // dCollide divides the gap by the same fractions when it places a contact. So this is the place where the bodies touch.
  for (dContact& contact : ahead.contacts)
    ode::from_vector(ode::to_vector(contact.geom.pos) + displacements.first + displacements.second, contact.geom.pos);
  return displacements;
}

// A body bounces at most once a step. Its other contacts are found again in the next step, with its new velocity. A plastic contact
// would take this velocity away. So the body may overlap a little there.
void SpeculativeSetup::close_or_bounce(const PairMaterial& pair, Patch& ahead, bool may_approach) {
  const auto bounce_of = [&](const dContact& contact, const Displacements& displacements) {
    return find_bounce(pair, Separation::at(contact, ahead, displacements.first, displacements.second), step_);
  };
  Displacements displacements;
  if (may_approach) {
    const dContact* first = nullptr;
    double time = 0;
    for (const dContact& contact : ahead.contacts) {
      const std::optional<Bounce> bounce = bounce_of(contact, {});
      if (bounce && (first == nullptr || bounce->time < time)) first = &contact, time = bounce->time;
    }
    if (first != nullptr) displacements = bring_to_touch(*first, time, ahead);
  }
  const Vector3 displacement = displacements.first - displacements.second;
  for (dContact& contact : ahead.contacts) {
    const double gap = std::max(0.0, displacement.dot(ode::to_vector(contact.geom.normal)) - double{contact.geom.depth});
    const std::optional<Bounce> bounce = bounce_of(contact, displacements);
    if (!bounce) {
      let_close(contact, gap, step_);
    } else if (displacement.isZero(0)) {
      let_close(contact, gap + kShallow * least_half_extent(ahead), step_);
    } else {
      let_leave(contact, *bounce);
    }
  }
}

void SpeculativeSetup::set_up(const PairMaterial& pair, Patch& ahead, bool may_approach) {
  for (dContact& contact : ahead.contacts) contact.surface.mode &= ~dContactBounce;
  if (pair.restitution > 0) return close_or_bounce(pair, ahead, may_approach);
  for (dContact& contact : ahead.contacts) let_close(contact, -double{contact.geom.depth}, step_);
}

void SpeculativeSetup::approach() {
  for (const auto& [body, displacement] : approaches_) {
    const Vector3 place = ode::to_vector(dBodyGetPosition(body)) + displacement;
    dBodySetPosition(body, ode::to_real(place.x()), ode::to_real(place.y()), ode::to_real(place.z()));
  }
  approaches_.clear();
  displaced_.clear();
}

void SpeculativeSetup::plan(dBodyID body, const Vector3& displacement) {
  approaches_.push_back({body, displacement});
  displaced_.insert(body);
}

void SpeculativeSetup::remove(dBodyID body) {
  if (displaced_.erase(body) == 0) return;
  std::erase_if(approaches_, [&](const Approach& approach) { return approach.body == body; });
}

}  // namespace supernormal::effects
