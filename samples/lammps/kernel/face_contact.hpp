// The contact of two flat faces.
#pragma once

#include <array>
#include <optional>

#include "kernel/body.hpp"
#include "kernel/face.hpp"
#include "kernel/ground.hpp"

namespace granular {

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

}  // namespace granular
