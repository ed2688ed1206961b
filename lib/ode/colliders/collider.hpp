// The queries and colliders of our geoms with every class of geom: one file each in convex/, trimesh/ and heightfield/. A new
// class needs such a file with a query, a collider of its own if it has several contacts, and a line in the table of
// collider.cpp.
#pragma once

#include <ode/ode.h>

#include "ode/colliders/goal.hpp"
#include "supernormal/contact/contact_manifold.hpp"

namespace supernormal::ode {

/// A query finds the proximity of a geom of ours and a collider (the other geom of the pair, of any class) in the world frame,
/// with the normal from ours to the collider, and for Goal::Contacts the corners of the overlap. It counts itself in the
/// statistics and throws what the core throws.
using PairQuery = ContactManifold(dGeomID ours, dGeomID collider, Goal goal);

PairQuery query_body;  // both geoms are ours
PairQuery query_plane;
PairQuery query_sphere;
PairQuery query_box;
PairQuery query_capsule;
PairQuery query_cylinder;
PairQuery query_convex;
PairQuery query_ray;
PairQuery query_trimesh;
PairQuery query_heightfield;

/// The dColliderFn for a geom of ours and a collider, in this order: ODE swaps the contacts when it was called with the other
/// order. Colliders that only write the contacts of their query need no such function (see collide_by in collider.cpp).
dColliderFn collide_with_ray;
dColliderFn collide_with_trimesh;
dColliderFn collide_with_heightfield;

/// The dGetColliderFnFn of our class: 0 for unknown classes; ODE then asks the other class, if it is a user's.
dColliderFn* find_collider(int collider_class);

/// Null for unknown classes.
PairQuery* find_query(int collider_class);

/// Enters our colliders for all of ODE's own classes, and for our own class, into ODE's table.
void set_colliders(int our_class);

}  // namespace supernormal::ode
