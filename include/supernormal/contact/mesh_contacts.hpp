// A body against the triangles of a surface: a mesh or a heightfield.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A triangle of a surface, as the caller has it.
struct MeshTriangle {
  std::array<Vector3, 3> vertices;  ///< m, world frame; counter-clockwise seen from outside
  int index = 0;                    ///< the caller's name for the triangle
};

/// A contact of a body with a surface.
struct MeshContact {
  Proximity proximity;  ///< world frame; body 1 is the body, body 2 the surface
  int triangle = 0;     ///< MeshTriangle::index
};

class MeshContactSearch;

/// Finds contacts. It owns the scratch memory: keep one per thread, and after the first queries nothing is allocated any more.
/// Nothing else is carried over from one query to the next.
///
/// The surface is single-sided: behind a triangle is solid. The triangles have to be all those that touch the body's box
/// (body_box.hpp); others do not count, and the order does not matter. Neighbours are recognised by the vertices that they share,
/// which are the same up to 1e-6 of the smaller triangle's longest side. Triangles without area, repeated ones and those with a
/// coordinate that is not finite or beyond 1e30 are skipped.
class SUPERNORMAL_API MeshContacts {
 public:
  MeshContacts();
  ~MeshContacts();
  MeshContacts(MeshContacts&&) noexcept;             ///< takes over the scratch memory
  MeshContacts& operator=(MeshContacts&&) noexcept;  ///< takes over the scratch memory

  /// The distinct contacts of the body with the surface, deepest first, in the world frame. A contact is a local maximum of the
  /// gap function over the normals of one feature of the surface (lib/proximity/README.md), with a gap that is not positive:
  ///
  ///  * a face, when the body's deepest point lies under it, or under the wall that the face runs into: explicit, with the digits
  ///    of find_plane_proximity();
  ///  * a convex edge, over the arc between the normals of its two faces;
  ///  * the open border of a sheet, with the face's normal where the body stands on the sheet: its deepest point is below the
  ///    face's plane by up to a tenth of the body's extent along the normal. The depth is that of the body over the border. From a
  ///    fifth on the normal is that of the arc, up to 90 degrees from the face's; in between it turns from one to the other;
  ///  * a vertex, over the normals with whose tangent plane no triangle there violates the normal cone;
  ///  * a face that the body crosses, if there is nothing else: from there the way up.
  ///
  /// Over one edge, at one vertex and for one convex part of the solid there is one contact: the one with the minimum translation
  /// distance (MTD).
  ///
  /// Inner edges of flat and concave parts have no such normals, so there are no ghost contacts. Proximity::contact is the body's
  /// point, as with a plane, and of a flat side that point of it that is over the feature. Of the settings only the tolerance and
  /// the limit of evaluations are used: the hybrid solves the vertices. The result is valid until the next query; empty when the
  /// pose is not finite, or its rotation none (Pose).
  std::span<const MeshContact> find(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                    const Settings& settings = {});

  /// Evaluations of the support function and the gap function in the last query.
  int evaluations() const;

 private:
  std::unique_ptr<MeshContactSearch> search_;
};

/// Draws the corners of a manifold with a plane (find_plane_contact_manifold() of a contact of MeshContacts) in, towards the
/// deepest point, to where there are triangles in that plane, without a hole on the way: a brick that hangs over the border of a
/// table is supported as far as the table goes. Leaves no corners where the contact is not on a face. `triangles` are at least
/// those within manifold.margin of the body; their order does not matter.
SUPERNORMAL_API void draw_in_corners(ContactManifold& manifold, std::span<const MeshTriangle> triangles);

/// The proximity, in the world frame, of the body and the triangle with the smallest gap, all taken as two-sided. Degenerate
/// triangles count as the segment or point that they are; those with a coordinate that is not finite or beyond 1e30 are skipped.
/// Status::InvalidInput when none is left. Proximity::evaluations counts those of all triangles that were tried: most are ruled
/// out by the supporting planes of the body at the nearest one found so far.
SUPERNORMAL_API MeshContact find_nearest_triangle(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                                  const Settings& settings = {});

}  // namespace supernormal
