// The contacts of flat faces and straight sides: of two bodies, with the ground, and with the inside of a pipe.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "kernel/body.hpp"
#include "kernel/face.hpp"

namespace granular {

/// A convex polygon of a plane, counter-clockwise, m.
using Patch = std::span<const Vector2>;

/// A plane, or what there is of it.
struct Ground {
  Matrix3 frame;                     ///< columns: two axes in the plane, and the normal out of the ground; right-handed
  Vector3 origin;                    ///< m; a point of the plane
  std::span<const Patch> patches{};  ///< without common points, from `origin`, along both axes; all of the plane without patches
  /// Whether patches are the coplanar triangles of a surface, which bear a body as their plane if they are all under it. Otherwise
  /// there is one patch, which bears the part of the body over it.
  bool is_surface = false;
  double width = std::numeric_limits<double>::infinity();  ///< m; of the patch
  double tilt = std::numeric_limits<double>::infinity();   ///< rad; as in Face

  /// The plane through a point (m). `normal` is unit, out of the ground.
  static Ground plane(const Vector3& point, const Vector3& normal);
};

/// The inside of an infinite cylinder.
struct Pipe {
  Vector3 point;  ///< m; of the axis
  Vector3 axis;   ///< unit
  double radius;  ///< m
};

/// A corner of the region in which two faces overlap. Its depth is linear in the motion of both bodies:
/// d(depth) = (normal + lateral) . (displacement of body 1 at `point` - displacement of body 2).
struct FaceCorner {
  Vector3 point;    ///< m
  Vector3 normal;   ///< unit, from body 1 to body 2
  Vector3 lateral;  ///< along the faces: the point moves along a sloped edge
  double depth;     ///< m; > 0
  double weight;    ///< the turning angle of the region's outline here, as a fraction of a full turn
};

/// Two faces that overlap.
///
/// The mean of the squared depths over the corners replaces the squared depth of the deepest point, so the bodies rest. A corner
/// has the weight of its turning angle. Corners that merge or split therefore change no mean: it is a continuous function of the
/// poses, and its gradient, here in closed form, keeps the energy.
///
/// `share` tells how far the faces replace the deepest point: 1 where they meet, less if they overlap only a little, and 0 from
/// twice their Face::tilt on.
struct FaceContact {
  /// Two polygons overlap in at most twice their vertices. Edges that coincide to rounding may repeat some.
  static constexpr int kMostCorners = 4 * Face::kMostVertices;

  std::array<FaceCorner, kMostCorners> corners;
  int count = 0;                              ///< the first `count` are valid; the others of the region are not in contact
  double mean_square = 0;                     ///< m^2; the mean of the squared depths
  Vector3 turning = Vector3::Zero();          ///< m^2; d(mean_square) by a rotation of body 1, with depths and points fixed
  double mean = 0;                            ///< m; the mean of the depths, where corners that are not in contact have none
  Vector3 turning_of_mean = Vector3::Zero();  ///< m; d(mean) by a rotation of body 1, with depths and points fixed
  double share = 0;                           ///< in [0, 1]
  Vector3 share_by_way = Vector3::Zero();     ///< 1/m; d(share) by a displacement of body 1
  Vector3 share_by_turn = Vector3::Zero();    ///< d(share) by a rotation of body 1 about `origin`
  Vector3 origin;                             ///< m
};

/// The contact of the faces of two bodies that face each other along `normal` (unit, from body 1 to body 2). Nothing if one of the
/// bodies has no such face, or if `share` is 0.
std::optional<FaceContact> find_face_contact(const Body& body1, const Body& body2, const Vector3& normal);

/// The contact of a body's face or side with the ground. A side has two corners, the ends of its line, with half of the weight
/// each.
std::optional<FaceContact> find_ground_contact(const Body& body, const Ground& ground);

/// The contact of a body's side with the ground. The common line has two corners, its ends, with half of the weight each. Nothing
/// if the body has no side there, or if `share` is 0.
std::optional<FaceContact> find_side_contact(const Body& body, const Ground& ground);

/// The contact of two sides that run around their bodies, such as two cans with parallel axes. Each end of the common line has
/// the depth of the two sections across the mean axis. `normal` (unit, from body 1 to body 2) is a guess. `share` also falls if
/// the bodies cross, so that the middle of the line is deeper than its ends.
std::optional<FaceContact> find_side_pair_contact(const Body& body1, const Body& body2, const Vector3& normal);

/// The contact of a side that runs around a body with a pipe along it, at the contact `which` of those with these normals (unit,
/// outwards). Each end of the side is a corner of the contact whose normal is nearest to the normal of the end: askew, a can
/// touches with each end at another place. No corner belongs to a `which` past the last.
std::optional<FaceContact> find_pipe_contact(const Body& body, const Pipe& pipe, std::span<const Vector3> normals,
                                             std::size_t which);

}  // namespace granular
