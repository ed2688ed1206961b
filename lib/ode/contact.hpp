// From the answer of a query to dContactGeoms.
#pragma once

#include <ode/ode.h>

#include "supernormal/contact_patch.hpp"
#include "supernormal/shapes/shape.hpp"
#include "supernormal/solvers/proximity.hpp"

namespace supernormal::ode {

/// What dCollide wants to have filled.
struct ContactArray {
  dGeomID o1, o2;  ///< as the collider got them
  int flags;       ///< low 16 bits: room for so many contacts
  dContactGeom* first;
  int skip;  ///< bytes from one contact to the next

  int room() const { return flags & 0xffff; }
};

/// Writes a contact if the geoms touch or overlap, with it the corners of the patch as far as there is room for them, and returns
/// how many were written. This is the one place where the normal changes from the core's direction (o1 to o2) to ODE's (into o1).
///
/// A query that ended without convergence gives a contact as well: whatever its normal n, moving the bodies apart by -s(n) along n
/// does separate them, so that the depth errs on the safe side, and no contact at all would let them fall through each other.
int write_contacts(const ContactPatch& patch, const ContactArray& out);

/// The same for pairs with several contacts: writes one behind the `count` that are there, if there is room, and returns how many
/// are there now. `side2`: which part of o2 it is (the triangle of a mesh), -1 where geoms have no parts.
int append_contact(const Proximity& proximity, const ContactArray& out, int count, int side2 = -1);

/// The corners of a patch whose deepest point has been written, behind the `count` contacts that are there.
int append_corners(const ContactPatch& patch, const ContactArray& out, int count, int side2 = -1);

}  // namespace supernormal::ode
