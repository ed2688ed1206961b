// What the colliders have in common that are solved as a pair of shapes.
#pragma once

#include <ode/ode.h>

#include <cstdint>

#include "ode/api/last_error.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/contact.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// One of ODE's own geoms as the core sees it.
struct ColliderShape {
  const Shape& shape;
  Pose pose;
  std::uint32_t kind;  ///< collider_kind()
};

/// The query of the pair, from its last normal if there is one; counts itself.
///
/// Of such a collider's normals we remember those in its own frame, under where our body is seen from there: on a floor made of a
/// dBox or rolling along a wall a body has the same normal and nearly the same place, however it turns.
ContactManifold solve_pair(dGeomID ours, const ColliderShape& collider, Goal goal);

/// The dColliderFn that makes contacts of what the query finds.
template <PairQuery kQuery>
int collide_by(dGeomID ours, dGeomID collider, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const ContactArray out{ours, collider, flags, contacts, skip};
    return write_contacts(kQuery(ours, collider, out.room() > 1 ? Goal::Contacts : Goal::OneContact), out);
  });
}

}  // namespace supernormal::ode
