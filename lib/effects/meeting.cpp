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

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "effects/motion.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/bounce.hpp"

namespace supernormal::effects {
namespace {

// A light body between two heavy ones bounces ever faster. After so many impacts a body has no other one in the step. With 8, gases
// of bricks gain up to 3 % in 2 s at 50 ms, and up to 8 of 54 bricks that lose nothing leave a box if a heavy ball hits them at 20
// ms. With 16 to 64 these gases change by 1 % at most.
constexpr int kMostImpacts = 64;

// Relative to the largest velocity that an impact has to change: what counts as rounding. From 1e-2 to 1e-13 energies stay the
// same.
constexpr double kRounding = 1e-9;

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

/// The impulses p >= 0 with the least p A p / 2 - b p: the velocity that A p lacks of b is 0 where an impulse acts, and at most 0
/// elsewhere (Lawson and Hanson 1974, chapter 23). Exact impulses keep the energy. With 100 sweeps over the contacts, which
/// converge slowly if these are near each other, ellipsoids gain up to 3 % in 100 impacts.
Eigen::VectorXd solve_impulses(const Eigen::MatrixXd& responses, const Eigen::VectorXd& lacking) {
  Eigen::VectorXd impulses = Eigen::VectorXd::Zero(lacking.size());
  Eigen::VectorXd acts = impulses;  // 1 where an impulse acts
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(lacking.size());
  for (Eigen::Index turn = 0, next = 0; turn < 3 * lacking.size(); ++turn) {
    const Eigen::VectorXd left = (all - acts).cwiseProduct(lacking - responses * impulses);
    if (!(left.maxCoeff(&next) > kRounding * lacking.maxCoeff())) break;
    acts[next] = 1;
    for (Eigen::Index first = 0; first >= 0;) {  // whose impulse becomes 0 first on the way to `solved`
      Eigen::MatrixXd among = acts.asDiagonal() * responses * acts.asDiagonal();
      among.diagonal() += responses(0, 0) * (all - acts);
      const Eigen::VectorXd solved = among.ldlt().solve(acts.cwiseProduct(lacking));
      double part = 1;
      first = -1;
      for (Eigen::Index k = 0; k < lacking.size(); ++k) {
        if (impulses[k] + part * (solved[k] - impulses[k]) < 0) part = impulses[k] / (impulses[k] - solved[k]), first = k;
      }
      impulses += part * (solved - impulses);
      if (first >= 0) impulses[first] = acts[first] = 0;
    }
  }
  return impulses;
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

// Bodies are moved once a step at most, before their first impact. Later impacts act where the bodies are. Otherwise there would be
// no place for the first contact that is right for both of its bodies. A pair that touches elsewhere would overlap there.
bool Meeting::may_be_moved() const {
  return body1.impacts == 0 && body2.impacts == 0 && std::ranges::none_of(contacts, &MeetingContact::touches);
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
// rotation brings nearer stays a gap: gravity does no work on it.
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
void Meeting::strike(const Impact& impact) const {
  if (may_be_moved()) bring_to_touch(impact);
  std::vector<MeetingContact*> struck;
  for (MeetingContact& c : contacts) {
    if (time_of_bounce(pair, Separation::at(c, body1, body2), step)) struck.push_back(&c);
  }
  const auto count = static_cast<Eigen::Index>(struck.size());
  Eigen::MatrixXd pushes(12, count);   // linear and angular impulses on both bodies by unit impulses
  Eigen::MatrixXd changes(12, count);  // of the velocities by them
  Eigen::VectorXd lacking(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const MeetingContact& c = *struck[static_cast<std::size_t>(k)];
    const Separation separation = Separation::at(c, body1, body2);
    lacking[k] = -(1 + pair.restitution) * (separation.velocity + separation.acceleration * step / 2);
    const Vector3 moment1 = arm(c, body1, body2).cross(c.normal), moment2 = -arm(c, body2, body1).cross(c.normal);
    pushes.col(k) << c.normal, moment1, -c.normal, moment2;
    changes.col(k) << body1.inverse_mass * c.normal, body1.inverse_inertia * moment1, -body2.inverse_mass * c.normal,
        body2.inverse_inertia * moment2;
  }
  const Eigen::VectorXd impulses = solve_impulses(pushes.transpose() * changes, lacking);
  for (Eigen::Index k = 0; k < count; ++k) {
    struck[static_cast<std::size_t>(k)]->is_hit = true;
    struck[static_cast<std::size_t>(k)]->total += impulses[k];
  }
  const Eigen::VectorXd change = changes * impulses;
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

// The force acts towards the centre of mass: linear in a rotation of any size, a corner would gain energy.
void Meeting::stop_at_wall() const {
  for (MeetingContact& c : contacts) {
    MeetingContact central = c;
    const Vector3 out = body1.centre - ode::to_vector(c.contact.geom.pos);
    ode::from_vector(body1.centre - c.normal.dot(out) * c.normal, central.contact.geom.pos);
    const Separation now = Separation::at(central, body1, body2);
    const double room = std::max(0.0, now.gap) + kShallow * least_half_extent(c.contact.geom);
    const double lacking = -room / step - now.velocity - step * now.acceleration;
    if (!may_bounce) c = central;
    if (!(lacking > 0)) continue;
    c = central;
    c.total = 0;
    body1.velocity += lacking * c.normal;
    ++body1.impacts;
  }
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
  const Resultant sum = find_resultant(contacts, at);
  bool part = false;
  if (sum.carrier != nullptr) {
    const Vector3 point = sum.place + body1.displacement + body2.displacement;
    const Parting parting = parting_at(point, at.normal);
    const double gap = now.gap + double{at.contact.geom.depth} - sum.depth;
    part = parting.after * step >= -std::max(0.0, gap);
    if (part && sum.carrier == &at) {
      ode::from_vector(point, row.geom.pos);
      let_leave(row, parting.before, parting.after);
      return row;
    }
  }
  const bool may_sink = (part && at.is_hit) || time_of_bounce(pair, now, step);
  const double allowed = may_sink ? kShallow * least_half_extent(row.geom) : 0;
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
