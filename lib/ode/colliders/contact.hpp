// Conversion of query results to dContactGeom.
#pragma once

#include <ode/ode.h>

#include <span>

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// The array that dCollide has to fill.
struct ContactArray {
  dGeomID o1, o2;  ///< in the order of the collider's arguments
  int flags;       ///< the low 16 bits are max_contacts
  dContactGeom* first;
  int skip;  ///< stride between contacts in bytes

  int max_contacts() const { return flags & 0xffff; }
};

/// One manifold of a pair. A pair with a mesh has several.
struct LocatedManifold {
  ContactManifold manifold;
  int side2 = -1;  ///< which part of o2 touches (the triangle of a mesh); -1 if o2 has no parts
};

/// Reduces the manifold to max_contacts and writes its contacts if the geoms touch or overlap. Returns how many were written.
/// `side2`: see LocatedManifold. Only here does the normal change from the direction of the core (o1 to o2) to the direction of ODE
/// (into o1).
///
/// An unconverged query gives a contact, too. For any normal n, a displacement of -s(n) along n separates the bodies, so the depth
/// is an upper bound. Without a contact the bodies would fall through each other.
int write_contacts(const ContactManifold& manifold, const ContactArray& out, int side2 = -1);

/// The same for several manifolds, deepest first. Each manifold gets one contact. The rest of max_contacts is shared evenly.
/// Reduces the manifolds in place.
int write_contacts(std::span<LocatedManifold> manifolds, const ContactArray& out);

}  // namespace supernormal::ode
