// Impacts of one pair of bodies: when they touch, how they part, and the rows of ODE's solver that let them do so.
#pragma once

#include <ode/ode.h>

#include <optional>
#include <span>
#include <vector>

#include "effects/pair_material.hpp"
#include "ode/geom/convert.hpp"

namespace supernormal::effects {

/// Relative to the smallest half-extent: the depth that bodies may reach that cannot bounce in this step. They bounce from there in
/// the next one. Their middles stay outside.
inline constexpr double kShallow = 0.5;

/// With so many impacts in a step a body does not bounce in it: a light body between two heavy ones would bounce ever faster.
inline constexpr int kMostImpacts = 64;

/// A body within a step. Its impacts move it and change its velocity before ODE does.
struct MovingBody {
  static MovingBody of(dBodyID body);

  dBodyID id = nullptr;                        ///< 0: a wall at rest
  double inverse_mass = 0;                     ///< 1/kg; 0 for a wall or a kinematic body
  Matrix3 inverse_inertia = Matrix3::Zero();   ///< 1/(kg m^2), world frame
  Vector3 centre = Vector3::Zero();            ///< m, at the start of the step
  Vector3 velocity = Vector3::Zero();          ///< m/s, as ODE has it at the start of the step, and after the impacts so far
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s
  Vector3 acceleration = Vector3::Zero();      ///< m/s^2
  Vector3 displacement = Vector3::Zero();      ///< m, to its first impact
  Vector3 gain = Vector3::Zero();              ///< m/s, by forces on this way
  double time = 0;                             ///< s, of its last impact, from the start of the step
  int impacts = 0;
  bool is_thrown_back = false;  ///< by a wall that has no contact for it
  int impacts_searched = 0;     ///< the impacts after which walls were searched
  bool is_attached = false;     ///< whether a joint holds it in place: moved alone, it would violate the joint
};

/// A contact at which two bodies may meet.
struct MeetingContact {
  MeetingContact(const dContact& set_up) : contact(set_up), normal(ode::to_vector(set_up.geom.normal)) {}

  dContact contact;      ///< at the start of the step, with friction and without a normal motion
  Vector3 normal;        ///< unit, world frame, into body 1
  double total = 0;      ///< N s, of the impacts so far
  bool is_hit = false;   ///< whether any impact of the step has acted here
  bool is_stop = false;  ///< whether a wall stops the body here

  /// Whether the bodies touch here at the start of the step.
  bool touches() const { return !(contact.geom.depth < 0); }
};

/// Linear and angular parts of body 1, and of body 2.
using OfBoth = Eigen::Matrix<double, 12, 1>;

/// A place where an impulse may act on two bodies.
struct Push {
  MeetingContact* at;
  double lacking;                   ///< m/s; how much faster the bodies have to part
  OfBoth impulse = OfBoth::Zero();  ///< for 1 N s along the normal
  OfBoth change = OfBoth::Zero();   ///< of the velocities by it
  double total = 0;                 ///< N s
};

/// Finds the least impulses with which no place lacks velocity, and returns the change of velocities by them. Reorders the places.
OfBoth solve_impulses(std::span<Push> pushes);

/// All contacts of two geoms.
struct Meeting {
  struct Impact {
    double time;            ///< s, from the start of the step
    MeetingContact* first;  ///< where the bodies touch first
  };

  const PairMaterial& pair;
  MovingBody& body1;
  MovingBody& body2;
  std::span<MeetingContact> contacts;
  double step;      ///< s
  bool may_bounce;  ///< whether the bodies have impacts here

  /// Empty if there is no impact that the bodies may make now.
  std::optional<Impact> next_impact() const;

  /// Gives the bodies the velocities after the next impact, and moves them to touch before their first one. `pushes`: memory.
  void strike(const Impact& impact, std::vector<Push>& pushes) const;

  /// Whether one of the bodies is a wall, which nothing moves.
  bool is_at_wall() const { return !(body1.inverse_mass > 0 && body2.inverse_mass > 0); }

  /// A contact under the middle of the free body, at which it bounces before its middle passes the wall within the step. Empty if
  /// it does not pass.
  std::optional<MeetingContact> middle() const;

  /// Adds what keeps the middle of the free body outside of the wall in this step.
  void add_stops(std::vector<Push>& pushes) const;

  /// The contact for ODE, so that the step ends with the velocities after the impacts so far.
  dContact row_of(const MeetingContact& at) const;

  /// The contact for ODE that stops the free body at a wall.
  dContact stop_of(const MeetingContact& at) const;

 private:
  bool is_first_free() const { return body1.inverse_mass > 0; }
  const MovingBody& free_body() const { return is_first_free() ? body1 : body2; }
  Vector3 inwards_at(const MeetingContact& at) const { return is_first_free() ? at.normal : Vector3(-at.normal); }
  static dContact under(const Vector3& centre, const MeetingContact& at);
  double room_at(const MeetingContact& at) const;
  double lacking_at(const MeetingContact& at) const;
  void bring_to_touch(const Impact& impact) const;
  struct Parting {
    double before, after;  // m/s
  };
  Parting parting_at(const Vector3& point, const Vector3& normal) const;
};

/// Lets the contact close its gap (m) within the step (s).
void let_close(dContact& contact, double gap, double step);

}  // namespace supernormal::effects
