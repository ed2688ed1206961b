// The query and collider that all classes share that are solved as a pair of shapes.
#pragma once

#include <ode/ode.h>

#include <cstdint>

#include "ode/api/last_error.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/contact.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// One of ODE's own geoms as a shape of the core.
struct ColliderShape {
  const Shape& shape;
  Pose pose;
  std::uint32_t kind;  ///< collider_kind()
};

/// Solves the pair, from its last normal if there is one, and counts the query.
///
/// The remembered normals are in the collider's own frame, and the key is the direction in which our body is seen from there: on
/// a floor made of a dBox or rolling along a wall a body has the same normal and nearly the same place, however it turns.
ContactManifold solve_pair(dGeomID ours, const ColliderShape& collider, Goal goal);

/// The dColliderFn that writes the contacts of a query.
template <PairQuery kQuery>
int collide_by(dGeomID ours, dGeomID collider, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const ContactArray out{ours, collider, flags, contacts, skip};
    return write_contacts(kQuery(ours, collider, out.room() > 1 ? Goal::Contacts : Goal::OneContact), out);
  });
}

}  // namespace supernormal::ode
