// The corners of a contact manifold where the floor is made of triangles.
#pragma once

#include <span>

#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/contact/contact_manifold.hpp"

namespace supernormal {

/// Draws the corners of a manifold with a plane in, towards the deepest point, to where there are triangles in that plane,
/// without a hole on the way: a brick that hangs over the border of a table is supported as far as the table goes. Leaves no
/// corners where the contact is not on a face. `triangles` are at least those within manifold.margin of the body; their order does
/// not matter.
void draw_in_corners(ContactManifold& manifold, std::span<const MeshTriangle> triangles);

}  // namespace supernormal
