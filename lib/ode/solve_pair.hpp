// What the partners have in common that are solved as a pair of shapes.
#pragma once

#include <ode/ode.h>

#include <cstdint>

#include "ode/contact.hpp"
#include "ode/last_error.hpp"
#include "ode/partner.hpp"
#include "supernormal/shapes/shape.hpp"
#include "supernormal/solvers/pose.hpp"

namespace supernormal::ode {

/// One of ODE's own geoms as the core sees it.
struct PartnerShape {
  const Shape& shape;
  Pose pose;
  std::uint32_t kind;  ///< partner_kind()
};

/// The query of the pair, from its last normal if there is one; counts itself.
///
/// Of such a partner's normals we remember those in its own frame, under where our body is seen from there: on a floor made of a
/// dBox or rolling along a wall a body has the same normal and nearly the same place, however it turns.
ContactManifold solve_pair(dGeomID ours, const PartnerShape& partner, Goal goal);

/// The dColliderFn that makes contacts of what the query finds.
template <PairQuery kQuery>
int collide_by(dGeomID ours, dGeomID partner, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const ContactArray out{ours, partner, flags, contacts, skip};
    return write_contacts(kQuery(ours, partner, out.room() > 1 ? Goal::Contacts : Goal::OneContact), out);
  });
}

}  // namespace supernormal::ode
