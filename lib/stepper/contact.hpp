// Contacts as rows: what an impulse at each does to the velocities of two bodies.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

#include "stepper/body.hpp"
#include "stepper/surface.hpp"

namespace supernormal::stepper {

/// One direction in which a contact pushes.
struct Row {
  Vector3 direction;       ///< unit; of the force on body 1; body 2 has the opposite
  Vector3 lever1, lever2;  ///< m; (place - centre of mass) x direction
  Vector3 response1,
      response2;        ///< 1/(kg m); the changes of the angular velocities by a unit impulse, of body 2 with the sign of body 1
  double mobility = 0;  ///< 1/kg; the change of velocity by a unit impulse
  double impulse = 0;   ///< N s; in the present sub-step, so far
  double later = 0;     ///< N s; the part of the last impulse that follows after the positions
  double recalled = 0;  ///< N s; the impulse in a sub-step by the force of the last step
  double total = 0;     ///< N s; in the sub-steps so far
  double motion = 0;    ///< m/s; the velocity that the surface asks for
  double centring = 0;  ///< m/s; half of what turning geometry takes from the velocity in a sub-step (moving_contacts.hpp)
};

/// How a contact gives way: an impulse changes by -mass (velocity + rate gap) / mobility - keep impulse.
struct Softness {
  double rate = 0;  ///< 1/s
  double mass = 1;
  double keep = 0;
};

struct Contact {
  int body1 = 0, body2 = 0;  ///< in System::bodies
  std::array<Row, 3> rows;   ///< along the normal, and two across it
  double gap = 0;            ///< m; when the step began; of a contact that moves: now
  double layer = 0;          ///< m; the overlap that is not corrected
  double deepest = 0;        ///< m; a deeper overlap is corrected no faster than this one
  double size = 0;           ///< m; of the smaller of its moving bodies
  double tangent_mass = 0;   ///< kg; for both directions across the normal
  Softness softness;
  double impact = 0;                     ///< N s; along the normal, of an impact
  double separation_speed = 0;           ///< m/s; after the impact
  Vector3 of_impacts = Vector3::Zero();  ///< N s; on body 1, of all impacts of the step
  const Surface* surface = nullptr;
  double part_before = 1;  ///< the part of its last impulse that acts before the positions
  bool moves = false;      ///< whether place and normal follow the bodies within the step
  int rolling = -1;        ///< in System::rolling; -1: none
  int given = 0;           ///< its number in the order in which the program added it
  Vector3 place1, place2;  ///< m; in the frames of the bodies
  dGeomID geom1 = nullptr, geom2 = nullptr;

  const Row& normal() const { return rows[0]; }
  Row& normal() { return rows[0]; }
};

/// Torques about the two directions across a contact's normal and about the normal. The axis of a row is its lever; its direction
/// is 0.
using Rolling = std::array<Row, 3>;

/// All contacts of two geoms, one after the other.
struct Pair {
  int first = 0, count = 0;
};

/// What one step solves.
struct System {
  std::vector<Body> bodies{1};  ///< the first one does not move
  std::vector<Contact> contacts;
  std::vector<Pair> pairs;
  std::vector<Rolling> rolling;

  Body& body1(const Contact& contact) { return bodies[static_cast<std::size_t>(contact.body1)]; }
  Body& body2(const Contact& contact) { return bodies[static_cast<std::size_t>(contact.body2)]; }
  const Body& body1(const Contact& contact) const { return bodies[static_cast<std::size_t>(contact.body1)]; }
  const Body& body2(const Contact& contact) const { return bodies[static_cast<std::size_t>(contact.body2)]; }
  Contact& contact(int index) { return contacts[static_cast<std::size_t>(index)]; }
  const Contact& contact(int index) const { return contacts[static_cast<std::size_t>(index)]; }

  Rolling* rolling_of(const Contact& contact) {
    return contact.rolling < 0 ? nullptr : &rolling[static_cast<std::size_t>(contact.rolling)];
  }

  /// Calls visit(contact, row) for all rows.
  template <typename Visit>
  void for_each_row(const Visit& visit) {
    for (Contact& contact : contacts) {
      for (Row& row : contact.rows) visit(contact, row);
      if (Rolling* const torques = rolling_of(contact)) {
        for (Row& row : *torques) visit(contact, row);
      }
    }
  }

  /// m/s, or rad/s; of body 1 against body 2.
  double velocity(const Contact& contact, const Row& row) const {
    const Body& one = body1(contact);
    const Body& two = body2(contact);
    return row.direction.dot(one.velocity - two.velocity) + row.lever1.dot(one.angular_velocity) -
           row.lever2.dot(two.angular_velocity);
  }

  /// m; between the places that touched or were nearest when the step began.
  double gap(const Contact& contact) const {
    if (contact.moves) return contact.gap;
    const Body& one = body1(contact);
    const Body& two = body2(contact);
    const Row& row = contact.normal();
    return contact.gap + row.direction.dot(one.moved - two.moved) + row.lever1.dot(one.rotated) - row.lever2.dot(two.rotated);
  }

  void push(const Contact& contact, const Row& row, double impulse) {
    Body& one = body1(contact);
    Body& two = body2(contact);
    one.velocity += impulse * one.inverse_mass * row.direction;
    one.angular_velocity += impulse * row.response1;
    two.velocity -= impulse * two.inverse_mass * row.direction;
    two.angular_velocity -= impulse * row.response2;
  }
};

/// Sets the directions and responses of a contact at `place` (m), with the bodies where they are now. The first direction across
/// the normal is `along`, projected.
void set_rows(System& system, Contact& contact, const Vector3& place, const Vector3& normal, const Vector3& along);

/// Sets up the contact that a program has given.
Contact contact_of(System& system, const dContact& given, const Surface& surface, int body1, int body2);

}  // namespace supernormal::stepper
