// Contacts as rows: what an impulse at each does to the velocities of two bodies.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "stepper/joint.hpp"

namespace supernormal::stepper {

/// A largest force or torque: a multiple of the normal force, or a constant.
struct Limit {
  double value = 0;  ///< dimensionless or m; N or N m
  bool is_of_normal = false;

  /// N s or N m s; in `time` (s), with a normal impulse (N s). 0 without one: what is apart does not rub.
  double in(double time, double normal_impulse) const {
    return normal_impulse > 0 ? value * (is_of_normal ? normal_impulse : time) : 0;
  }

  /// N s or N m s; in no time, in which a force has no impulse.
  double of_impact(double normal_impulse) const { return is_of_normal || std::isinf(value) ? value * normal_impulse : 0; }
};

/// What a contact's surface asks for: dSurfaceParameters, tested and without flags.
struct Surface {
  std::array<Limit, 2> friction;   ///< along the two directions across the normal
  std::array<Limit, 3> rolling;    ///< about these directions and about the normal
  std::array<double, 3> motion{};  ///< m/s; along the normal, and across it
  std::array<double, 2> slip{};    ///< m/(N s)
  double bounce = 0;               ///< separating velocity over approach velocity
  double bounce_speed = 0;         ///< m/s; slower impacts do not bounce
  double erp = -1;                 ///< of quickstep's contact; negative: not chosen
  double cfm = -1;                 ///< 1/(N s/m); negative: not chosen
  bool has_direction = false;      ///< whether fdir1 is the first direction

  bool slips() const { return slip[0] > 0 || slip[1] > 0; }
  bool rolls() const { return rolling[0].value > 0 || rolling[1].value > 0 || rolling[2].value > 0; }
};

/// Throws std::invalid_argument if a number is out of range. The message names it.
Surface surface_of(const dContact& contact);

// rad; the phase of a contact's spring in a sub-step. With half of it loads press in four times as far, with twice as much they are
// thrown (README).
inline constexpr double kPhase = 0.4 * 3.14159265358979323846;

// The damping ratio of a contact's spring: an overlap is corrected in some 20 sub-steps, and nothing swings (README).
inline constexpr double kDampingRatio = 10;

// Relative to the size: a deeper overlap is corrected no faster than this one, or bodies that a program puts into one another are
// thrown apart (README).
inline constexpr double kDeep = 0.1;

/// How a contact gives way: a spring and a damper, integrated implicitly, so what a sweep has not solved cannot ring.
/// An impulse changes by -mass (velocity + rate gap) / mobility - keep impulse.
struct Softness {
  double rate = 0;  ///< 1/s
  double mass = 1;
  double keep = 0;
  double deepest = 0;  ///< relative to the size; a deeper overlap is corrected no faster than this one
};

/// The softness of a contact in a sub-step of `time` (s), with a spring that turns by kPhase in `spring` (s).
inline Softness softness_in(double time, double spring) {
  const double phase = kPhase * time / spring;
  const double damping = phase * (2 * kDampingRatio + phase);
  return {phase / (2 * kDampingRatio + phase) / time, damping / (1 + damping), 1 / (1 + damping), kDeep};
}

/// The softness of a contact with quickstep's ERP and CFM, m/(N s), in sub-steps of `time` of a `step` (s). It is the spring and
/// the damper that these two numbers are to quickstep.
inline Softness softness_of(double erp, double cfm, double mobility, double step, double time) {
  if (cfm == 0) return {erp / step, 1, 0, kAny};
  const double spring = erp / (step * cfm);  // N/m
  const double damper = (1 - erp) / cfm;     // N s/m
  const double resistance = time * spring + damper;
  const double compliance = 1 / (time * resistance);  // 1/kg
  return {spring / resistance, mobility / (mobility + compliance), compliance / (mobility + compliance), kAny};
}

/// A contact as a program gave it.
struct Given {
  dContact contact;
  Surface surface;
  int body1, body2;   ///< in System::bodies; -1: the body was removed
  Softness softness;  ///< if the surface has its own
  dJointFeedback feedback;
};

struct Contact : Link {
  std::array<Row, 3> rows;   ///< along the normal, and two across it
  double impact = 0;         ///< N s; along the normal, of all impacts so far in the step
  double first_gap = 0;      ///< m; when the step began
  double gap = 0;            ///< m; when the bodies last moved
  double size = 0;           ///< m; System::size
  double layer = 0;          ///< m; an overlap that is not corrected
  double tangent_mass = 0;   ///< kg; for both directions across the normal
  bool will_bounce = false;  ///< in a later sub-step, by the velocities that the bodies had before this one's sweeps
  const Given* given = nullptr;
  const Softness* softness = nullptr;
  int rolling = -1;  ///< in System::rolling; -1: none
  int moving = -1;   ///< in System::centring, if place and normal follow the bodies within the step; -1: they do not

  const Row& normal() const { return rows[0]; }
  Row& normal() { return rows[0]; }
  const Surface& surface() const { return given->surface; }
  bool is_idle() const { return rows[0].impulse == 0 && rows[1].impulse == 0 && rows[2].impulse == 0; }
};

/// Torques about the two directions across a contact's normal and about the normal.
using Rolling = std::array<Row, 3>;

/// All contacts of two geoms, one after the other.
struct Pair {
  int first = 0, count = 0;
};

/// An impact at a contact.
struct Impact {
  double speed = 0;    ///< m/s; after it; 0: none
  double impulse = 0;  ///< N s
};

/// What one step solves.
struct System {
  std::vector<Body> bodies{1};  ///< the first one does not move
  std::vector<Joint*> joints;
  std::vector<Contact> contacts;
  std::vector<Pair> pairs;
  std::vector<Rolling> rolling;
  /// m/s; half of what turning geometry takes from the velocities in a sub-step, world frame (moving_contacts.hpp).
  std::vector<Vector3> centring;
  std::vector<Impact> impacts;  ///< of the pair that bounces
  bool has_bounces = false;     ///< whether a contact has a restitution

  Body& body1(const Link& link) { return bodies[static_cast<std::size_t>(link.body1)]; }
  Body& body2(const Link& link) { return bodies[static_cast<std::size_t>(link.body2)]; }
  const Body& body1(const Link& link) const { return bodies[static_cast<std::size_t>(link.body1)]; }
  const Body& body2(const Link& link) const { return bodies[static_cast<std::size_t>(link.body2)]; }

  std::span<Contact> contacts_of(const Pair& pair) {
    return std::span(contacts).subspan(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.count));
  }
  Rolling* rolling_of(const Contact& contact) {
    return contact.rolling < 0 ? nullptr : &rolling[static_cast<std::size_t>(contact.rolling)];
  }

  /// m; of the smaller of the bodies that move.
  double size(const Link& link) const { return std::min(body1(link).size, body2(link).size); }

  /// m/s; of body 1 against body 2.
  Vector3 velocity(const Link& link) const {
    const Body& one = body1(link);
    const Body& two = body2(link);
    return one.velocity - two.velocity + one.angular_velocity.cross(link.arm1) - two.angular_velocity.cross(link.arm2);
  }
  /// rad/s; of body 1 against body 2.
  Vector3 spin(const Link& link) const { return body1(link).angular_velocity - body2(link).angular_velocity; }

  /// A kinematic body turns below the place of the other body: what rides on it takes the velocity that it has where the other one
  /// will be in `time` (s). In a biased sweep that is half a sub-step, so that it follows the arc and not the tangent.
  void ride(Contact& contact, double time) const {
    const Body& one = body1(contact);
    const Body& two = body2(contact);
    if (contact.moving >= 0 || (one.is_dynamic() && two.is_dynamic())) return;
    const Vector3 apart = one.centre() - two.centre() + time * (one.velocity - two.velocity);
    if (!two.is_dynamic()) contact.arm2 = contact.arm1 + apart;
    if (!one.is_dynamic()) contact.arm1 = contact.arm2 - apart;
  }

  /// After the bodies have moved: the gap of the places that touched or were nearest when the step began.
  void update_gap(Contact& contact) const {
    if (contact.moving >= 0) return;
    const Body& one = body1(contact);
    const Body& two = body2(contact);
    const Vector3 moved = one.moved - two.moved + one.rotated.cross(contact.arm1) - two.rotated.cross(contact.arm2);
    contact.gap = contact.first_gap + contact.normal().direction.dot(moved);
  }

  void push(const Link& link, const Row& row, double impulse) {
    body1(link).velocity += impulse * body1(link).inverse_mass * row.direction;
    body2(link).velocity -= impulse * body2(link).inverse_mass * row.direction;
    turn(link, row, impulse);
  }
  void turn(const Link& link, const Row& row, double impulse) {
    body1(link).angular_velocity += impulse * row.response1;
    body2(link).angular_velocity -= impulse * row.response2;
  }

  /// Pushes along both directions across the normal.
  void push_across(const Contact& contact, double first, double second) {
    const auto& [normal, along, across] = contact.rows;
    Body& one = body1(contact);
    Body& two = body2(contact);
    const Vector3 sum = first * along.direction + second * across.direction;
    one.velocity += one.inverse_mass * sum;
    two.velocity -= two.inverse_mass * sum;
    one.angular_velocity += first * along.response1 + second * across.response1;
    two.angular_velocity -= first * along.response2 + second * across.response2;
  }

  /// Pushes by the last impulses of a contact or a joint, or by the part of them that acts before the positions.
  template <typename Pushing>
  void push_before(Pushing& link) {
    if (link.part_before < 1) {
      for_each_row_of(link, [&](Row& row) {
        row.later = row.impulse * (1 - link.part_before);
        row.impulse -= row.later;
      });
    }
    push_all(link, &Row::impulse);
  }
  /// Pushes by the other part.
  template <typename Pushing>
  void push_after(Pushing& link) {
    if (link.part_before == 1) return;
    push_all(link, &Row::later);
    for_each_row_of(link, [](Row& row) { row.impulse += row.later; });
  }

 private:
  template <typename Visit>
  void for_each_row_of(Contact& contact, const Visit& visit) {
    std::ranges::for_each(contact.rows, visit);
    if (Rolling* const torques = rolling_of(contact)) std::ranges::for_each(*torques, visit);
  }
  template <typename Visit>
  void for_each_row_of(Joint& joint, const Visit& visit) {
    std::ranges::for_each(joint.rows(), visit);
  }

  void push_all(const Contact& contact, double Row::*impulse) {
    const auto& [normal, along, across] = contact.rows;
    if (normal.*impulse == 0 && along.*impulse == 0 && across.*impulse == 0) return;  // then nothing rolls, either
    push(contact, normal, normal.*impulse);
    push_across(contact, along.*impulse, across.*impulse);
    if (const Rolling* const torques = rolling_of(contact)) {
      for (const Row& row : *torques) turn(contact, row, row.*impulse);
    }
  }
  void push_all(const Joint& joint, double Row::*impulse) {
    for (const Row& row : joint.rows()) {
      const bool is_linear = joint.is_linear(static_cast<int>(&row - joint.rows().data()));
      is_linear ? push(joint, row, row.*impulse) : turn(joint, row, row.*impulse);
    }
  }
};

/// Sets the directions and responses of a contact at `place` (m), with the bodies where they are now. The first direction across
/// the normal is `along`, projected.
void set_rows(System& system, Contact& contact, const Vector3& place, const Vector3& normal, const Vector3& along);

/// Sets the responses of the rows of a contact as its bodies are turned now.
void set_responses(System& system, Contact& contact);

/// Sets up the contact that a program has given for a step of `time` (s).
Contact contact_of(System& system, const Given& given, double time);

}  // namespace supernormal::stepper
