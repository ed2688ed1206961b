// Contacts that follow their bodies within a step.
#pragma once

#include <vector>

#include "stepper/contact.hpp"
#include "supernormal/proximity/pose.hpp"

namespace supernormal::stepper {

/// The one contact of two bodies that roll or rock is elsewhere in every sub-step. Frozen for a step it feeds in energy: a rocking
/// ellipsoid has 1.6 to 3.4 times its energy after ten seconds. A contact is a function of a normal, so moving it costs one
/// evaluation of the gap function.
class MovingContacts {
 public:
  /// Chooses the contacts of `system` that move in a step (s) and sets Contact::moving.
  void choose(System& system, double step);

  /// Brings gap, place and normal to the bodies' present poses.
  void follow(System& system) const;

  /// Before the bodies move: the velocities at the contacts, along their rows.
  void begin_turn(const System& system);

  /// After the contacts have followed: the next biased sweep aims at half of what the turning took from the velocities, against it.
  /// Then a sub-step is centred in time, and reversible. With 0 as its aim, it loses energy to first order.
  void end_turn(System& system) const;

 private:
  struct Side {
    const Shape* shape = nullptr;  // null: the plane
    Pose in_body;                  // the geom's pose in the frame of its body
  };
  struct Moving {
    /// Whether both geoms are ours, or one of them and a plane.
    bool read_sides(const System& system, const Contact& at);
    void follow(System& system) const;

    int contact = 0;  // in System::contacts
    Side side1, side2;
    Vector3 plane_normal = Vector3::Zero();  // in the frame of the plane's body, to which a program may give a kinematic one
    Vector3 plane_point = Vector3::Zero();   // m; in the same frame
    bool is_fixed = false;                   // to both bodies
    Vector3 place1, place2;                  // m; in the frames of the bodies, if fixed
    Vector3 before = Vector3::Zero();
  };
  void choose_of(System& system, const Pair& pair, double step);

  std::vector<Moving> list_;
};

}  // namespace supernormal::stepper
