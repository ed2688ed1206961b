// Contacts of a body with the triangles of a surface: a mesh or a heightfield.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A triangle of a surface.
struct MeshTriangle {
  std::array<Vector3, 3> vertices;  ///< m; world frame; counter-clockwise seen from outside
  int index = 0;                    ///< the caller's index of the triangle
  double rounding = 0;              ///< m; how far a vertex may be from its place, if fewer digits were stored than a double has
};

/// A contact of a body with a surface.
struct MeshContact {
  Proximity proximity;  ///< world frame; body 1 is the body, body 2 the surface
  int triangle = 0;     ///< MeshTriangle::index
};

class MeshContactSearch;

/// Finds contacts of a body with triangles. It owns scratch memory: use one object per thread. After the first queries nothing is
/// allocated. No other state is kept between queries.
///
/// The surface is single-sided: the space behind a triangle is solid. The triangles must include all that touch the body's box
/// (body_box.hpp). Other triangles have no effect, and the order does not matter. Triangles are neighbours if they share vertices,
/// which are equal if they are closer than 1e-6 of the smaller triangle's longest side plus twice their rounding. Neighbours are
/// coplanar if their rounding explains the angle between them. Some triangles are skipped: those without area, repeated ones, and
/// triangles with a coordinate that is not finite or beyond 1e30.
class SUPERNORMAL_API MeshContacts {
 public:
  MeshContacts();
  ~MeshContacts();
  MeshContacts(MeshContacts&&) noexcept;             ///< takes over the scratch memory
  MeshContacts& operator=(MeshContacts&&) noexcept;  ///< takes over the scratch memory

  /// The distinct contacts of the body with the surface, deepest first, in the world frame. A contact is a local maximum of the gap
  /// function over the normals of one feature of the surface (lib/proximity/README.md), with a gap of at most 0. The features are:
  ///
  ///   - A face, if the body's deepest point is under it, or under the wall that the face meets. This contact is explicit, and as
  ///   exact as
  ///     find_plane_proximity().
  ///   - A convex edge, over the arc between the normals of its two faces.
  ///   - The open border of a sheet. If the body stands on the sheet, the contact has the face's normal and the body's depth over
  ///   the
  ///     border. The body stands on the sheet if its deepest point is at most a tenth of the body's extent along the normal below
  ///     the face's plane. From a fifth on, the normal is the best one of the arc, up to 90 degrees from the face's. In between it
  ///     is interpolated.
  ///   - A vertex, over its normal cone: no triangle at the vertex is beyond the tangent plane.
  ///   - A face that crosses the body, if there is no other contact. The contact leads out of it.
  ///
  /// One edge, one vertex or one convex part of the solid gives one contact: the one with the minimum translation distance (MTD).
  ///
  /// Inner edges of flat and concave parts have no such normals, so there are no ghost contacts. Proximity::contact is the body's
  /// point, as with a plane. For a flat side of the body it is the side's point over the feature. Of the settings only the
  /// tolerance and the limit of evaluations are used, because the hybrid solves the vertices. The result is valid until the next
  /// query. It is empty if the pose is not finite, or its matrix is not a rotation (Pose).
  std::span<const MeshContact> find(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                    const Settings& settings = {});

  /// The contacts with faces that continue behind a wall, where find() left them out: a contact with a similar normal is as deep.
  /// A body that moves along that one is held back by these. Valid until the next query.
  std::span<const MeshContact> continued() const;

  /// Whether a unit normal out of the surface is in the normal cone at a point of the surface (m), which the last query knows: no
  /// triangle that touches the point rises from the tangent plane. The edge of a triangle in a plane or a valley has no such
  /// normal.
  bool has_normal(const Vector3& normal, const Vector3& point) const;

  /// Number of evaluations of the support function and the gap function in the last query.
  int evaluations() const;

 private:
  friend class MeshContactsAhead;

  /// The same for gaps up to `distance` (m).
  SUPERNORMAL_LOCAL std::span<const MeshContact> find_within(double distance, const Shape& shape, const Pose& pose,
                                                             std::span<const MeshTriangle> triangles, const Settings& settings);

  std::unique_ptr<MeshContactSearch> search_;
};

/// Moves the manifold points of a contact with a plane to where the surface supports them. `manifold` comes from
/// find_plane_contact_manifold() for a contact of MeshContacts. Each point moves towards the deepest point until there are
/// triangles in this plane, without a hole in between. So a brick that hangs over the border of a table is supported as far as the
/// table extends. The manifold points are removed if the contact is not on a face. `triangles` must include all within
/// manifold.margin of the body; their order does not matter.
SUPERNORMAL_API void draw_in_corners(ContactManifold& manifold, std::span<const MeshTriangle> triangles);

/// The nearest triangle of the surface and its proximity with the body, in the world frame. All triangles count as two-sided. A
/// degenerate triangle counts as a segment or point. A triangle with a coordinate that is not finite or beyond 1e30 is skipped;
/// Status::InvalidInput if none is left. Proximity::evaluations is the sum over all examined triangles: supporting planes of the
/// body at the nearest one so far exclude most triangles.
SUPERNORMAL_API MeshContact find_nearest_triangle(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                                  const Settings& settings = {});

}  // namespace supernormal
