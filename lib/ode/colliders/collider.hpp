// Queries and colliders of our geoms with every geometry class. Each class has one file in convex/, trimesh/ or heightfield/.
// To add a class that is a shape of the core, add it to convex/primitives.cpp. Another one is a file with a query and a line in the
// table of collider.cpp. A class with several contacts also needs its own collider.
#pragma once

#include <ode/ode.h>

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// The kind of a query. Queries for contacts need overlaps only, so they stop at the first normal that proves separation.
enum class QueryKind {
  OneContact,  ///< the deepest point
  Contacts,    ///< the contact manifold
  Distance,
  CertifiedDistance,  ///< with a proof that the depth of overlapping bodies is minimal
};

/// Whether it is a query of dCollide.
inline bool is_for_contacts(QueryKind kind) { return kind == QueryKind::OneContact || kind == QueryKind::Contacts; }

inline Settings settings_for(Settings settings, QueryKind kind) {
  settings.stop_when_apart = is_for_contacts(kind);
  settings.certify_depth = kind == QueryKind::CertifiedDistance;
  return settings;
}

/// A query finds the proximity of a geom of ours and a collider (the other geom of the pair, of any class). Frame: world. The
/// normal points from ours to the collider. For QueryKind::Contacts the result includes the contact manifold. A query counts itself
/// in the statistics. Throws like the core.
using PairQuery = ContactManifold(dGeomID ours, dGeomID collider, QueryKind kind);

PairQuery query_body;  // both geoms are ours
PairQuery query_plane;
PairQuery query_primitive;  // convex/primitives.hpp
PairQuery query_convex;
PairQuery query_ray;
PairQuery query_trimesh;
PairQuery query_heightfield;

/// The dColliderFn of a geom of ours and a collider, in this order. ODE swaps the contacts of a call in the other order. A collider
/// that only writes the contacts of its query uses collide_by in collider.cpp instead.
dColliderFn collide_with_ray;
dColliderFn collide_with_trimesh;
dColliderFn collide_with_heightfield;

/// The dGetColliderFnFn of our class. Returns null for an unknown class: ODE then asks the other class, if that is a user class.
dColliderFn* find_collider(int collider_class);

/// Returns null for an unknown class.
PairQuery* find_query(int collider_class);

/// Registers our colliders with ODE, for the geometry classes of ODE and for our own.
void set_colliders(int our_class);

/// Throws std::invalid_argument with the reason why the core answers Status::InvalidInput for two geoms. The names of the
/// caller's arguments are for the message; without them it has the classes only.
[[noreturn]] void refuse_pair(dGeomID ours, dGeomID collider, const char* our_name = nullptr, const char* collider_name = nullptr);

/// Throws std::invalid_argument for a collider of a class that no query takes.
[[noreturn]] void refuse_class(dGeomID collider, const char* name = "the collider");

}  // namespace supernormal::ode
