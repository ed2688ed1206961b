// A contact region of two bodies: the contacts of dCollide with one normal.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <cstddef>
#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::effects {

/// Moves the contacts that a condition holds for to the front, in their order, and returns their number.
template <typename Condition>
std::size_t move_to_front(std::span<dContact> contacts, const Condition& is_first) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (is_first(contacts[k])) std::rotate(&contacts[count++], &contacts[k], &contacts[k] + 1);  // std::stable_partition allocates
  }
  return count;
}

/// Whether two contacts of a pair belong to one region: their normals are equal to rounding.
bool is_same_region(const dContact& a, const dContact& b);

/// The contacts of one pair with the same normal. Their order, number and depths are arbitrary. A collider may return the vertices
/// of the region, its deepest point, points within it, or the same point twice.
struct Patch {
  std::span<dContact> contacts;
  double step;    ///< s
  int kept;       ///< the first `kept` contacts may be attached; a pass may move others behind them
  dBodyID body1;  ///< the body of geom.g1's side; 0: a wall at rest
  dBodyID body2;
  int coarse = 0;  ///< compliant contacts among them that last fewer than ten steps

  dGeomID geom1() const { return contacts.front().geom.g1; }
  dGeomID geom2() const { return contacts.front().geom.g2; }
  Vector3 normal() const;         ///< unit, world frame, into geom1
  double greatest_depth() const;  ///< m

  /// The fraction of a force on the whole region that acts at contact k, such that the resultant acts in the middle of the region.
  /// The fraction is the contact's normal cone over the full circle: the directions in the plane in which this contact is the
  /// outermost. So the middle is the Steiner point of the contacts' convex hull: the centre of a rectangle, the middle of an edge.
  /// It depends on the hull alone, and continuously. A contact inside the hull has the fraction 0. Contacts at one place divide
  /// their fraction equally.
  double fraction_at(std::size_t k) const;

  /// m; the middle of the region: the resultant of fraction_at() acts there.
  Vector3 middle() const;

  /// m; the depth-weighted mean of the contacts, or the middle if no contact has a depth.
  Vector3 centre_of_depth() const;
};

}  // namespace supernormal::effects
