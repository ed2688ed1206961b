// The region in which two bodies touch, as the contacts that dCollide found in it.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::effects {

/// Whether two contacts of a pair belong to one region: their normals are the same but for rounding.
bool is_same_region(const dContact& a, const dContact& b);

/// Contacts of one pair with the same normal. Nothing is known of their order, their number and their depths: a collider may name
/// the vertices of the region, its deepest point, points within it, or a point twice.
struct Patch {
  std::span<dContact> contacts;
  double step;    ///< s
  int kept;       ///< contacts that may be attached; a pass may move others behind them
  dBodyID body1;  ///< of the side of geom.g1; 0: a wall at rest
  dBodyID body2;
  int coarse = 0;  ///< compliant contacts among them that last too few steps

  dGeomID geom1() const { return contacts.front().geom.g1; }
  dGeomID geom2() const { return contacts.front().geom.g2; }
  Vector3 normal() const;         ///< into geom1
  double greatest_depth() const;  ///< m

  /// The part of a force on the whole region that acts at contact k, so that the resultant acts in the middle of the region. It is
  /// the fraction of all directions in the plane in which this contact is the outermost, so the middle is the Steiner point of the
  /// contacts' convex hull: the centre of a rectangle, the middle of an edge. It depends on the hull alone, and continuously: a
  /// contact within the hull has no part, and contacts at one place share theirs.
  double fraction_at(std::size_t k) const;

  /// m; the middle of the region, where forces act that fraction_at() distributes.
  Vector3 middle() const;

  /// m; where a force acts that the contacts carry in proportion to their depths. The middle, if none has a depth.
  Vector3 centre_of_depth() const;
};

}  // namespace supernormal::effects
