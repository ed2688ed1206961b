// The kinds of geom that ours can meet. One file each: collider_body.cpp (our own), collider_plane.cpp, collider_sphere.cpp, …
// A new collider is such a file with a query, with a collider of its own if it has several contacts, and a line in the table of
// collider.cpp.
#pragma once

#include <ode/ode.h>

#include "ode/colliders/goal.hpp"
#include "supernormal/contact/contact_manifold.hpp"

namespace supernormal::ode {

/// The proximity of a geom of ours and a collider, in the world frame, the normal from ours to the collider, and for Goal::Contacts
/// the corners of the overlap. Counts itself in the statistics. Throws what the core throws.
using PairQuery = ContactManifold(dGeomID ours, dGeomID collider, Goal goal);

PairQuery query_body;  // ours and ours
PairQuery query_plane;
PairQuery query_sphere;
PairQuery query_box;
PairQuery query_capsule;
PairQuery query_cylinder;
PairQuery query_convex;
PairQuery query_ray;
PairQuery query_trimesh;
PairQuery query_heightfield;

/// dColliderFn for a geom of ours and a collider, in this order: ODE turns the contacts around when it was asked the other way.
/// Those that write the contacts of their query have no collider of their own.
dColliderFn collide_with_ray;
dColliderFn collide_with_trimesh;
dColliderFn collide_with_heightfield;

/// dGetColliderFnFn of our class: 0 for classes that we know nothing about; ODE then asks the other class, if it is a user's.
dColliderFn* find_collider(int collider_class);

/// Null for classes that we know nothing about.
PairQuery* find_query(int collider_class);

/// Enters our colliders for all of ODE's own classes, and for ourselves, into ODE's table.
void set_colliders(int our_class);

}  // namespace supernormal::ode
