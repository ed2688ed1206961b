// Several contact points for one overlap: what a flat face rests on.
#pragma once

#include <array>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// One of the points that a flat contact rests on.
struct ManifoldCorner {
  Vector3 point = Vector3::Zero();  ///< m; in the frame of the query
  double depth = 0;                 ///< m; depth of the overlap at `point`, from 0 to that of the deepest point; with contacts
                                    ///< ahead (contacts_ahead.hpp) it is negative where the bodies are apart
};

/// The deepest point of an overlap and, where the bodies are flat, the corners of the region on which they rest.
///
/// One exact point does not let a flat body rest: it jumps from edge to edge as the body tilts by a millionth of a radian. So
/// where both bodies are flat at the contact, the corners of the region that their support polygons have in common are the contact
/// points: up to four for a face on a face, two for a cylinder on its side, none where a body is round and must roll and rock on
/// the deepest point alone.
///
/// Everything is a continuous function of the pose. Corners grow out of the deepest point as the bodies become flat there; they
/// are as deep as it is where the face does not lean, and less deep by as much as it leans; where the leaning faces are apart they
/// have depth 0. The region does not shrink to a point as the depth goes to nothing, nor as it grows. lib/contact/README.md has the
/// construction, its proofs and measurements.
struct ContactManifold {
  static constexpr int kMaxCorners = 4;  ///< the most corners that a manifold has

  ContactManifold() = default;
  /// One contact, without corners.
  ContactManifold(const Proximity& proximity) : deepest(proximity) {}  // NOLINT(google-explicit-constructor): one point is one

  Proximity deepest;  ///< the point with the depth of the overlap: the contact if there are no corners
  std::array<ManifoldCorner, kMaxCorners> corners{};  ///< the first corner_count are valid, in order around the contact
  int corner_count = 0;                               ///< 0 or 4, some of which may be at the same place; see reduced_to()
  double same_place = 0;                              ///< m; corners that are nearer to each other are one contact
  double margin = 0;                                  ///< m; the bodies are apart by no more than this at a corner
  double reach = 0;     ///< m; what has a larger gap is no contact; 0 but for contacts ahead (contacts_ahead.hpp)
  double shallow = 0;   ///< m; a corner this much above the deepest weighs least where two are united; 0: the depth of the overlap
  int evaluations = 0;  ///< boundary points of one body that finding the corners took
};

/// The manifold of two bodies whose proximity is known. Corners are only looked for when the bodies overlap; they lie in the
/// plane of proximity.contact. The result is symmetric under swapping the bodies.
SUPERNORMAL_API ContactManifold find_contact_manifold(const Shape& shape1, const Pose& pose1, const Shape& shape2,
                                                      const Pose& pose2, const Proximity& proximity);

/// The manifold of a body and a plane, from find_plane_proximity(); the corners are points of the body.
SUPERNORMAL_API ContactManifold find_plane_contact_manifold(const Shape& shape, const Pose& pose, const Proximity& proximity);

/// Reduces the manifold to what a caller with room for so many contacts gets: the corners at distinct places, deepest first, or the
/// deepest point alone where there are none. The first has the depth of the overlap. With room for two or three, neighbours are
/// united at a place between them. The result is as continuous as the manifold.
SUPERNORMAL_API ContactManifold reduced_to(ContactManifold manifold, int room);

}  // namespace supernormal
