/// @namespace supernormal
/// Supernormal's core: bodies given by their normals, and queries of them. It needs Eigen, but not ODE. It is a library of its own
/// (supernormal::core, supernormal-core.pc, libsupernormal-core).
///
///     bodies       Ellipsoid, Superellipsoid, Superovoid; Sphere, Box, Capsule, Cylinder, Polytope; Rounded, MinkowskiSum,
///                  LinearImage; your own as a class derived from Shape, or as a CallbackShape
///     two bodies   find_proximity(): signed distance, common normal, witness points, contact point; certify_depth proves the
///                  depth. A Sphere of radius 0 is a point, a Polytope of three points a triangle
///     clearance    is_farther_than(), are_farther_than(), find_clearance(): proofs of a distance at the least cost
///     derivatives  find_proximity_derivatives(), find_plane_derivatives(), find_gap_gradient(): how gap, normal and points change
///                  with poses and parameters
///     many pairs   find_proximities(): the same answers; many ellipsoids and superellipsoids together cost less
///     over time    least_gap_after(): what a motion has left of a proved gap, without a query
///     others       find_plane_proximity(), find_ray_hit(), find_ray_proximity(), MeshContacts, find_nearest_triangle()
///     in motion    find_time_of_impact(), find_plane_time_of_impact(), find_mesh_time_of_impact(): when bodies meet; pose_at()
///     contacts     find_contact_manifold(), find_plane_contact_manifold(), draw_in_corners(), reduced_to(); hertz_correction(),
///                  hertz_damping_ratio()
///     ahead        find_contacts_ahead(), find_plane_contacts_ahead(), MeshContactsAhead: contacts of bodies that will meet;
///                  find_manifold_of_gaps(), find_plane_manifold_of_gaps(), nearness(), reach_towards()
///     one body     find_bounding_box(), Shape::mass_properties(), Shape::point(), find_curvature(), find_contact_curvature(),
///                  projected_area(), surface_area(), tessellate()
///     travel       describe(), read_shape(), read_pose(): shapes and poses as text, and back; clone(); ==
///
/// Units and frames: lengths are in m, or in any other unit that is used throughout. x_world = rotation x_body + position. Normals
/// are unit vectors and point from body 1 to body 2. A gap is positive if the bodies are apart, and negative if they overlap.
///
/// Errors: a constructor refuses bad parameters with std::invalid_argument, whose text contains the parameter, its value and the
/// valid range. Nothing is clamped. A query only throws if settings are out of range or spans differ in length. It reports all
/// other problems, such as numbers that are not finite or a limit reached, in Proximity::status.
///
/// Threads and memory: shapes and functions have no state, so any number of threads may use them at once. Queries allocate nothing,
/// except scratch memory that each thread keeps for deep overlaps and that grows with the first of them. MeshContacts and
/// MeshContactsAhead own theirs.
///
/// Warm start: find_proximity() takes the normal of an earlier pose, in body 1's frame. Keep pose1.rotation.transpose() * normal.
#pragma once

#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/contact_curvature.hpp"
#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/contact/hertz.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/contact/mesh_contacts_ahead.hpp"
#include "supernormal/impact/mesh_time_of_impact.hpp"
#include "supernormal/impact/motion.hpp"
#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/clearance.hpp"
#include "supernormal/proximity/derivatives.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/proximity/relative_curvature.hpp"
#include "supernormal/proximity/separation.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/bounding_box.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/description.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/parameter_gradient.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/shape.hpp"
#include "supernormal/shapes/silhouette.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/submerged_volume.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "supernormal/shapes/tessellation.hpp"
