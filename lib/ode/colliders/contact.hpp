// Conversion of the results of queries to dContactGeoms.
#pragma once

#include <ode/ode.h>

#include <span>

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// The array that dCollide wants to have filled.
struct ContactArray {
  dGeomID o1, o2;  ///< in the order in which the collider got them
  int flags;       ///< low 16 bits: room for so many contacts
  dContactGeom* first;
  int skip;  ///< bytes from one contact to the next

  int room() const { return flags & 0xffff; }
};

/// The manifold of one contact of a pair: with a mesh there are several.
struct LocatedManifold {
  ContactManifold manifold;
  int side2 = -1;  ///< the part of o2 that it is with (the triangle of a mesh); -1 where geoms have no parts
};

/// Writes the contacts of the manifold as reduced_to() the room if the geoms touch or overlap, and returns how many were written;
/// `side2` as in LocatedManifold. This is the one place where the normal changes from the core's direction (o1 to o2) to ODE's
/// (into o1).
///
/// A query that ended without convergence gives a contact as well: whatever its normal n, moving the bodies apart by -s(n) along
/// n does separate them, so that the depth errs on the safe side, and without a contact they would fall through each other.
int write_contacts(const ContactManifold& manifold, const ContactArray& out, int side2 = -1);

/// The same for several manifolds, deepest first, among which the room beyond one contact each is shared evenly. They are reduced
/// in place.
int write_contacts(std::span<LocatedManifold> manifolds, const ContactArray& out);

}  // namespace supernormal::ode
