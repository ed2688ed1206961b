// Several contact points for one overlap: what a flat face rests on.
#pragma once

#include <array>

#include "supernormal/shapes/shape.hpp"
#include "supernormal/solvers/pose.hpp"
#include "supernormal/solvers/proximity.hpp"

namespace supernormal {

/// The deepest point of an overlap and, when that is wide, the corners of what it rests on.
///
/// One exact point does not let a flat body rest: it jumps from edge to edge as the body tilts by a millionth of a radian. So where
/// two bodies overlap in a region that is wide against both, its corners become contact points too: four of a wide region, two of a
/// long and narrow one, none of one that is no wider than an ellipsoid's would be. Round bodies roll and rock on one point, as
/// they should.
///
/// Corners have the depth 0. They carry load as soon as the body tips onto them and push nothing apart: the depth, and with it
/// the force and the torque of a stiff or soft contact, is that of the deepest point, and nothing jumps when corners come and go.
/// They are looked for not only where the bodies overlap, but where they would if they were deeper by `margin`: five times the
/// depth, at most a fifth of the half-extent. For a body at rest this is micrometres. README, "Resting", has what it gives.
struct ContactPatch {
  static constexpr int kMaxCorners = 4;

  ContactPatch() = default;
  ContactPatch(const Proximity& proximity) : deepest(proximity) {}  // NOLINT(google-explicit-constructor): one point is a patch

  Proximity deepest;                           ///< the contact with the depth of the overlap
  std::array<Vector3, kMaxCorners> corners{};  ///< m; in the frame of the query; the first two are the farthest apart
  int corner_count = 0;                        ///< 0, 2 or 4; 3 of a triangle
  double margin = 0;                           ///< m; at a corner there is no more than this between the bodies
  int evaluations = 0;                         ///< boundary points of one body that finding the corners took
};

/// The patch of two bodies whose proximity is known. Corners are only looked for when they overlap; they lie in the plane of
/// proximity.contact. Symmetric under swapping the bodies.
SUPERNORMAL_API ContactPatch find_contact_patch(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                                const Proximity& proximity);

/// The patch of a body and a plane, from find_plane_proximity(); the corners lie in the plane.
SUPERNORMAL_API ContactPatch find_plane_contact_patch(const Shape& shape, const Pose& pose, const Proximity& proximity);

}  // namespace supernormal
