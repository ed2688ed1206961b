// Impacts of one pair, and contacts ahead of touch, as rows of ODE's solver.
//
// A row demands a separating velocity of at least u after the step. With u = -gap / step the gap may close in the step, and no more
// (Anitescu and Potra 1997). ODE's own restitution would add u to e times the approach velocity, and throw the body back by a
// mixture of both. So a pair that will bounce within the step is moved until it touches, before the step. The row then demands the
// velocity with which the bodies leave.
//
// ODE adds forces to velocities and then moves bodies with the new velocities. So its steps lie on a parabola with the velocity
// v + a h / 2 where ODE has v. With the velocities of the parabola, a ball on a plane bounces to e^2 times its height at any step.
#include "effects/meeting.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "effects/motion.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/bounce.hpp"

namespace supernormal::effects {
namespace {

// Relative to the largest velocity that an impact has to change: what counts as rounding. From 1e-2 to 1e-13 energies stay the
// same.
constexpr double kRounding = 1e-9;

// Relative to the smallest half-extent: where a wall stops the middle of a struck body.
constexpr double kMiddle = 0.1;

/// m; from the centre of a body to a contact, after the displacements of both bodies. dCollide divides the gap by the inverse
/// masses when it places a contact, and so are the displacements. So both displacements move it to where the bodies touch.
Vector3 arm(const MeetingContact& c, const MovingBody& body, const MovingBody& other) {
  return ode::to_vector(c.contact.geom.pos) + other.displacement - body.centre;
}

/// The relative motion of the bodies along the normal of a contact.
struct Separation {
  double gap;           // m; negative for an overlap
  double velocity;      // m/s, as ODE has it
  double acceleration;  // m/s^2
  double load;          // m/s^2; the larger acceleration of the two bodies, which contacts with other bodies may hold up

  static Separation at(const MeetingContact& c, const MovingBody& body1, const MovingBody& body2) {
    const double gap = c.normal.dot(body1.displacement - body2.displacement) - double{c.contact.geom.depth};
    const Vector3 velocity1 = body1.velocity + body1.angular_velocity.cross(arm(c, body1, body2));
    const Vector3 velocity2 = body2.velocity + body2.angular_velocity.cross(arm(c, body2, body1));
    const double acceleration1 = c.normal.dot(body1.acceleration);
    const double acceleration2 = c.normal.dot(body2.acceleration);
    return {gap, c.normal.dot(velocity1 - velocity2), acceleration1 - acceleration2,
            std::max(std::abs(acceleration1), std::abs(acceleration2))};
  }
};

/// s; the time until touch. Empty if the points do not touch within a step, approach below the threshold, or would touch again.
std::optional<double> time_of_bounce(const PairMaterial& pair, const Separation& separation, double step) {
  if (!(pair.restitution > 0) || !(separation.velocity < 0)) return std::nullopt;
  const auto touch = ode::find_touch(std::max(0.0, separation.gap), separation.velocity, separation.acceleration, step);
  if (!touch || !(touch->speed > pair.threshold)) return std::nullopt;
  if (!ode::is_impact(touch->speed, pair.restitution, separation.load, step)) return std::nullopt;
  return touch->time;
}

/// Overlapping bodies that part are not pushed apart: this would give them energy.
void correct_nothing(dContact& contact) {
  contact.surface.mode |= dContactSoftERP;
  contact.surface.soft_erp = 0;
}

/// Gives the contact a separating velocity (m/s) after the step, and no correction of its overlap.
void let_leave(dContact& contact, double before, double after) {
  dSurfaceParameters& surface = contact.surface;
  contact.geom.depth = std::max(dReal{0}, contact.geom.depth);
  correct_nothing(contact);
  surface.mode |= dContactMotionN;
  surface.motionN = ode::to_real(after);
  if (!(after > std::max(0.0, before))) return;
  // dWorldSetContactMaxCorrectingVel limits motionN, but not ODE's restitution. This acts on velocities below motionN.
  surface.mode |= dContactBounce;
  surface.bounce_vel = 0;
  surface.bounce = ode::to_real(before < 0 ? after / -before : 1);
  surface.motionN = ode::to_real((before + after) / 2);
  if (before < 0) surface.mode &= ~dContactMotionN;
}

/// m; of our geoms in the pair.
double least_half_extent(const dContactGeom& contact) {
  double least = std::numeric_limits<double>::infinity();
  for (const dGeomID geom : {contact.g1, contact.g2}) {
    if (const ode::Body* const ours = ode::find_body(geom)) least = std::min(least, ours->size());
  }
  return least;
}

/// The impulses of a region of contact, as one impulse.
struct Resultant {
  const MeetingContact* carrier = nullptr;  // the first contact with an impulse
  Vector3 place = Vector3::Zero();          // m, before the bodies are moved
  double depth = 0;                         // m, there
};

Resultant find_resultant(std::span<const MeetingContact> contacts, const MeetingContact& at) {
  Resultant sum;
  double impulse = 0;
  for (const MeetingContact& c : contacts) {
    if (!(c.total > 0) || !is_same_region(c.contact, at.contact)) continue;
    if (sum.carrier == nullptr) sum.carrier = &c;
    impulse += c.total;
    sum.place += c.total / impulse * (ode::to_vector(c.contact.geom.pos) - sum.place);
    sum.depth += c.total / impulse * (double{c.contact.geom.depth} - sum.depth);
  }
  return sum;
}

}  // namespace

// The impulses p >= 0 with the least p A p / 2 - b p: the velocity that A p lacks of b is 0 where an impulse acts, and at most 0
// elsewhere (Lawson and Hanson 1974, chapter 23). Exact impulses keep the energy. With 100 sweeps over the contacts, which
// converge slowly if these are near each other, ellipsoids gain up to 3 % in 100 impacts.
OfBoth solve_impulses(std::span<Push> pushes) {
  constexpr int kMost = 12;  // more impulses are not independent
  double most = 0;
  for (const Push& push : pushes) most = std::max(most, push.lacking);
  OfBoth change = OfBoth::Zero();
  Eigen::Matrix<double, kMost, kMost> responses;
  Eigen::Matrix<double, kMost, 1> lacking;
  std::size_t count = 0;  // the first ones act
  const auto at = [](std::size_t k) { return static_cast<Eigen::Index>(k); };
  for (std::size_t turn = 0; turn < 3 * pushes.size() && count < kMost; ++turn) {
    const auto left = [&](const Push& push) { return push.lacking - push.impulse.dot(change); };
    const auto next = std::ranges::max_element(pushes.subspan(count), {}, left);
    if (next == pushes.end() || !(left(*next) > kRounding * most)) break;
    std::swap(pushes[count], *next);
    lacking(at(count)) = pushes[count].lacking;
    for (std::size_t k = 0; k <= count; ++k) {
      responses(at(k), at(count)) = responses(at(count), at(k)) = pushes[count].impulse.dot(pushes[k].change);
    }
    ++count;
    for (bool is_solved = false; !is_solved;) {
      const auto solved = responses.topLeftCorner(at(count), at(count)).ldlt().solve(lacking.head(at(count))).eval();
      double part = 1;
      std::size_t first = count;  // whose impulse becomes 0 first on the way to `solved`
      for (std::size_t k = 0; k < count; ++k) {
        const double total = pushes[k].total;
        if (total + part * (solved(at(k)) - total) < 0) part = total / (total - solved(at(k))), first = k;
      }
      for (std::size_t k = 0; k < count; ++k) pushes[k].total += part * (solved(at(k)) - pushes[k].total);
      is_solved = first == count;
      if (is_solved) break;
      pushes[first].total = 0;
      std::swap(pushes[first], pushes[--count]);
      std::swap(lacking(at(first)), lacking(at(count)));
      responses.row(at(first)).swap(responses.row(at(count)));
      responses.col(at(first)).swap(responses.col(at(count)));
    }
    change.setZero();
    for (const Push& push : pushes.first(count)) change += push.total * push.change;
  }
  return change;
}

void let_close(dContact& contact, double gap, double step) {
  contact.surface.mode |= dContactMotionN;
  contact.surface.motionN = ode::to_real(-gap / step);
  contact.geom.depth = 0;
}

MovingBody MovingBody::of(dBodyID body) {
  MovingBody moving;
  moving.id = body;
  if (body == nullptr) return moving;
  moving.centre = ode::to_vector(dBodyGetPosition(body));
  moving.velocity = ode::to_vector(dBodyGetLinearVel(body));
  moving.angular_velocity = ode::to_vector(dBodyGetAngularVel(body));
  if (dBodyIsKinematic(body) != 0) return moving;
  dMass mass;
  dBodyGetMass(body, &mass);
  moving.inverse_mass = 1 / double{mass.mass};
  const Matrix3 rotation = ode::to_rotation(dBodyGetRotation(body));
  moving.inverse_inertia = rotation * ode::to_rotation(mass.I).inverse() * rotation.transpose();
  moving.acceleration = ode::acceleration_of(body, mass);
  return moving;
}

std::optional<Meeting::Impact> Meeting::next_impact() const {
  if (!may_bounce || std::max(body1.impacts, body2.impacts) >= kMostImpacts) return std::nullopt;
  const double start = std::max(body1.time, body2.time);
  std::optional<Impact> first;
  for (MeetingContact& c : contacts) {
    const auto time = time_of_bounce(pair, Separation::at(c, body1, body2), step);
    if (time && (!first || start + *time < first->time)) first = {start + *time, &c};
  }
  return first;
}

// Moves the bodies as far as their centres move until they touch, and gives them the velocities that forces add until then. What a
// rotation brings nearer stays a gap: gravity does no work on it. Bodies are moved once a step at most: for a later impact there
// would be no place for the first contact that is right for both of its bodies.
void Meeting::bring_to_touch(const Impact& impact) const {
  const Vector3 acceleration = body1.acceleration - body2.acceleration;
  Vector3 gain = impact.time * acceleration;
  Vector3 displacement = impact.time * (body1.velocity - body2.velocity + step / 2 * acceleration + gain / 2);
  // The contact has one place for both bodies, which is right for both only where they touch. A wall needs none.
  const Matrix3 along = impact.first->normal * impact.first->normal.transpose();
  if (!(body1.inverse_mass > 0 && body2.inverse_mass > 0)) displacement = along * displacement;
  gain = along * gain;
  const double share = body1.inverse_mass / (body1.inverse_mass + body2.inverse_mass);
  for (const auto& [body, part] : {std::pair{&body1, share}, std::pair{&body2, share - 1}}) {
    body->displacement = part * displacement;
    body->gain = part * gain;
    body->velocity += body->gain;
  }
}

// All contacts that would touch within a step of the first one are struck. Otherwise the end of the step may divide the impact of
// two faces.
void Meeting::strike(const Impact& impact, std::vector<Push>& pushes) const {
  if (body1.impacts == 0 && body2.impacts == 0) bring_to_touch(impact);
  pushes.clear();
  for (MeetingContact& c : contacts) {
    const Separation separation = Separation::at(c, body1, body2);
    if (!time_of_bounce(pair, separation, step)) continue;
    const Vector3 moment1 = arm(c, body1, body2).cross(c.normal), moment2 = -arm(c, body2, body1).cross(c.normal);
    Push push{&c, -(1 + pair.restitution) * (separation.velocity + separation.acceleration * step / 2)};
    push.impulse << c.normal, moment1, -c.normal, moment2;
    push.change << body1.inverse_mass * c.normal, body1.inverse_inertia * moment1, -body2.inverse_mass * c.normal,
        body2.inverse_inertia * moment2;
    pushes.push_back(push);
  }
  const OfBoth change = solve_impulses(pushes);
  for (const Push& push : pushes) {
    push.at->is_hit = true;
    push.at->total += push.total;
  }
  body1.velocity += change.segment<3>(0);
  body1.angular_velocity += change.segment<3>(3);
  body2.velocity += change.segment<3>(6);
  body2.angular_velocity += change.segment<3>(9);
  for (MovingBody* const body : {&body1, &body2}) {
    if (!(body->inverse_mass > 0)) continue;
    body->time = impact.time;
    ++body->impacts;
  }
}

/// m; how far the free body may approach the wall.
double Meeting::room_at(const MeetingContact& at) const {
  const Vector3 out = free_body().centre + free_body().displacement - ode::to_vector(at.contact.geom.pos);
  return std::max(0.0, inwards_at(at).dot(out) - double{at.contact.geom.depth} - kMiddle * least_half_extent(at.contact.geom));
}

/// m/s; how much too fast the middle of the free body approaches the wall.
double Meeting::lacking_at(const MeetingContact& at) const {
  const Vector3 wall = velocity_at(is_first_free() ? body2.id : body1.id, ode::to_vector(at.contact.geom.pos));
  return inwards_at(at).dot(wall - free_body().velocity - step * free_body().acceleration) - room_at(at) / step;
}

/// The contact at the place under `centre`.
dContact Meeting::under(const Vector3& centre, const MeetingContact& at) {
  dContact contact = at.contact;
  ode::from_vector(centre - at.normal.dot(centre - ode::to_vector(contact.geom.pos)) * at.normal, contact.geom.pos);
  return contact;
}

// The impact acts towards the centre. At the corner that swings in, 3 of 80 gases of long bodies change by more than 1 %, for 1,
// and bodies that move by many lengths in a step spin faster than ODE can follow.
std::optional<MeetingContact> Meeting::middle() const {
  if (!is_at_wall() || free_body().impacts >= kMostImpacts) return std::nullopt;
  for (const MeetingContact& at : contacts) {
    if (!(lacking_at(at) > 0)) continue;
    MeetingContact middle = under(free_body().centre, at);
    middle.contact.geom.depth = ode::to_real(inwards_at(at).dot(free_body().displacement) - room_at(at));
    if (time_of_bounce(pair, Separation::at(middle, body1, body2), step)) return middle;
  }
  return std::nullopt;
}

// The force acts towards the centre of mass: linear in a rotation of any size, a corner would gain energy.
void Meeting::add_stops(std::vector<Push>& pushes) const {
  for (MeetingContact& c : contacts) {
    Push push{&c, lacking_at(c)};
    push.impulse.head<3>() = inwards_at(c);
    push.change.head<3>() = free_body().inverse_mass * inwards_at(c);
    pushes.push_back(push);
  }
}

dContact Meeting::stop_of(const MeetingContact& at) const {
  dContact row = under(free_body().centre + free_body().displacement, at);
  row.surface.mode &= ~dContactBounce;
  let_close(row, room_at(at), step);
  return row;
}

/// The velocities with which the bodies part at a place, before the step and after it.
Meeting::Parting Meeting::parting_at(const Vector3& point, const Vector3& normal) const {
  const auto before = [&](const MovingBody& body) { return Vector3(velocity_at(body.id, point - body.displacement) + body.gain); };
  const auto after = [&](const MovingBody& body) {
    return Vector3(body.velocity + body.angular_velocity.cross(point - body.displacement - body.centre) + step * body.acceleration);
  };
  return {normal.dot(before(body1) - before(body2)), normal.dot(after(body1) - after(body2))};
}

// One row has the impulses of a region. Its contacts are not independent, and quickstep would need many iterations to divide the
// impulse among them. If forces bring the bodies together again in the step, they rest on all contacts.
//
// A row has one place for both bodies. After their displacements its lever arms are not those of the impacts. So a row that demands
// no impulse demands the velocity at its place with which the gap closes.
dContact Meeting::row_of(const MeetingContact& at) const {
  dContact row = at.contact;
  if (at.touches() && !may_bounce) return row;  // ODE's bounce
  row.surface.mode &= ~dContactBounce;
  const Separation now = Separation::at(at, body1, body2);
  if (std::max(body1.impacts, body2.impacts) >= kMostImpacts) {
    row.geom.depth = ode::to_real(-now.gap);
    if (now.gap > 0) let_close(row, now.gap, step);
    return row;
  }
  const Resultant sum = find_resultant(contacts, at);
  bool part = false;
  if (sum.carrier != nullptr) {
    const Vector3 point = sum.place + body1.displacement + body2.displacement;
    const Parting parting = parting_at(point, at.normal);
    const double gap = now.gap + double{at.contact.geom.depth} - sum.depth;
    part = at.is_stop || parting.after * step >= -std::max(0.0, gap);
    if (part && sum.carrier == &at) {
      ode::from_vector(point, row.geom.pos);
      let_leave(row, parting.before, parting.after);
      return row;
    }
  }
  if (at.is_stop) return stop_of(at);
  const double allowed = part && at.is_hit ? kShallow * least_half_extent(row.geom) : 0;
  const double excess = parting_at(ode::to_vector(row.geom.pos), at.normal).after - now.velocity - step * now.acceleration;
  if (now.gap + allowed > 0) {
    let_close(row, now.gap + allowed - step * excess, step);
    return row;
  }
  row.geom.depth = ode::to_real(-now.gap);
  row.surface.mode |= dContactMotionN;
  row.surface.motionN += ode::to_real(excess);
  const double reversible = (body1.acceleration.norm() + body2.acceleration.norm()) * step;
  if (now.velocity > reversible) correct_nothing(row);
  return row;
}

}  // namespace supernormal::effects
