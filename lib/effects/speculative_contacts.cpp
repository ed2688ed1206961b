// Contacts ahead of touch as rows of ODE's solver.
//
// A row asks for a separating velocity of at least u after the step. With u = -gap / step the gap may close in the step, and no
// more (Anitescu and Potra 1997). ODE's own restitution would add that target to e times the approach, and throw a body back by a
// mixture of both. So a pair that will bounce within the step is brought to touch before it, and the row asks for the velocity with
// which the bodies leave.
//
// ODE adds forces to velocities and then moves with the new ones. So its steps lie on the parabola that has the velocity v + a h /
// 2 where ODE has v. With the velocities of the parabola a ball on a plane keeps to e^2 times its height at any step.
#include "effects/speculative_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "effects/motion.hpp"
#include "ode/geom/body.hpp"

namespace supernormal::effects {
namespace {

// Of the smallest half-extent: how deep a body may come in that bounces elsewhere in the same step. Its middle stays outside.
constexpr double kShallow = 0.5;

/// How two points move relative to one another along the normal of a contact.
struct Separation {
  double gap;           // m
  double velocity;      // m/s, as ODE has it
  double acceleration;  // m/s^2

  /// With both bodies where they are before their ways.
  static Separation at(const dContact& contact, const Patch& patch, const Vector3& way1, const Vector3& way2) {
    const Vector3 n = ode::to_vector(contact.geom.normal);
    const Vector3 point = ode::to_vector(contact.geom.pos);
    return {-double{contact.geom.depth}, n.dot(velocity_at(patch.body1, point - way1) - velocity_at(patch.body2, point - way2)),
            n.dot(acceleration_of(patch.body1) - acceleration_of(patch.body2))};
  }
};

/// The motion of a step until touch.
struct Touch {
  double time;   // s
  double speed;  // m/s, of the approach
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

/// How points leave that touch within the step.
struct Bounce {
  double time;      // s, until touch
  double approach;  // m/s, as ODE has it at the start of the step
  double velocity;  // m/s, for ODE, with which they leave if they touch at the start of the step
};

/// None for points that do not touch within the step, not fast enough, or would again.
std::optional<Bounce> find_bounce(const PairMaterial& pair, const Separation& separation, double step) {
  const std::optional<Touch> touch = find_touch(separation, step);
  if (!touch || !(touch->speed > pair.threshold) || !(separation.velocity < 0)) return std::nullopt;
  const double velocity = pair.restitution * touch->speed + separation.acceleration * step / 2;
  if (!(velocity > 0)) return std::nullopt;
  return Bounce{touch->time, -separation.velocity, velocity};
}

/// Lets ODE's restitution give the contact its velocity, which a largest correcting velocity does not cut.
void let_leave(dContact& contact, const Bounce& bounce) {
  contact.surface.mode |= dContactBounce;
  contact.surface.bounce = ode::to_real(bounce.velocity / bounce.approach);
  contact.surface.bounce_vel = 0;
  contact.geom.depth = 0;
}

/// m, of the geoms of ours.
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

/// 1/kg; 0 for what does not give way.
double inverse_mass(dBodyID body) {
  if (body == nullptr || dBodyIsKinematic(body) != 0) return 0;
  dMass mass;
  dBodyGetMass(body, &mass);
  return 1 / double{mass.mass};
}

}  // namespace

/// Plans the ways of both bodies until `first` touches, `time` from now, and moves the contacts with them. No ways if one of the
/// bodies has one already, or none gives way.
SpeculativeSetup::Ways SpeculativeSetup::bring_to_touch(const dContact& first, double time, Patch& ahead) {
  const double inverse1 = inverse_mass(ahead.body1);
  const double inverse2 = inverse_mass(ahead.body2);
  if (!is_free(ahead.body1) || !is_free(ahead.body2) || !(inverse1 + inverse2 > 0)) return {};
  const Vector3 n = ode::to_vector(first.geom.normal);
  Vector3 way = double{first.geom.depth} * n;
  if (inverse1 > 0 && inverse2 > 0) {
    // One point of contact is right for the levers of both only where they touch.
    const Vector3 velocity = ode::to_vector(dBodyGetLinearVel(ahead.body1)) - ode::to_vector(dBodyGetLinearVel(ahead.body2));
    way += time * (velocity - n.dot(velocity) * n);
  }
  const Ways ways = {inverse1 / (inverse1 + inverse2) * way, -inverse2 / (inverse1 + inverse2) * way};
  if (inverse1 > 0) plan(ahead.body1, ways.first);
  if (inverse2 > 0) plan(ahead.body2, ways.second);
  // dCollide places a contact between both bodies by the same shares: it is to be where they touch.
  for (dContact& contact : ahead.contacts)
    ode::from_vector(ode::to_vector(contact.geom.pos) + ways.first + ways.second, contact.geom.pos);
  return ways;
}

// A body bounces once a step. What else it would meet is seen in the next step, with the velocity that it then has, and a plastic
// contact would cost it that. So there it may come in a little.
void SpeculativeSetup::close_or_bounce(const PairMaterial& pair, Patch& ahead, bool may_approach) {
  const auto bounce_of = [&](const dContact& contact, const Ways& ways) {
    return find_bounce(pair, Separation::at(contact, ahead, ways.first, ways.second), step_);
  };
  Ways ways;
  if (may_approach) {
    const dContact* first = nullptr;
    double time = 0;
    for (const dContact& contact : ahead.contacts) {
      const std::optional<Bounce> bounce = bounce_of(contact, {});
      if (bounce && (first == nullptr || bounce->time < time)) first = &contact, time = bounce->time;
    }
    if (first != nullptr) ways = bring_to_touch(*first, time, ahead);
  }
  const Vector3 way = ways.first - ways.second;
  for (dContact& contact : ahead.contacts) {
    const double gap = std::max(0.0, way.dot(ode::to_vector(contact.geom.normal)) - double{contact.geom.depth});
    const std::optional<Bounce> bounce = bounce_of(contact, ways);
    if (!bounce) {
      let_close(contact, gap, step_);
    } else if (way.isZero(0)) {
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
  for (const auto& [body, way] : approaches_) {
    const Vector3 place = ode::to_vector(dBodyGetPosition(body)) + way;
    dBodySetPosition(body, ode::to_real(place.x()), ode::to_real(place.y()), ode::to_real(place.z()));
  }
  approaches_.clear();
  on_their_way_.clear();
}

void SpeculativeSetup::plan(dBodyID body, const Vector3& way) {
  approaches_.push_back({body, way});
  on_their_way_.insert(body);
}

void SpeculativeSetup::remove(dBodyID body) {
  if (on_their_way_.erase(body) == 0) return;
  std::erase_if(approaches_, [&](const Approach& approach) { return approach.body == body; });
}

}  // namespace supernormal::effects
