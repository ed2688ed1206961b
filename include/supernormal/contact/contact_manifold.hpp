// The contact manifold: several contact points for one overlap, on which a flat face rests.
#pragma once

#include <array>
#include <optional>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A manifold point: one of the points of a flat contact.
struct ManifoldCorner {
  Vector3 point = Vector3::Zero();  ///< m; in the frame of the query
  double depth = 0;                 ///< m; of the overlap at `point`, from 0 to the depth of the deepest point. Contacts ahead
                                    ///< (contacts_ahead.hpp) have minus the gap, which is negative where the bodies are apart
};

/// The body on whose boundary the points of a contact ahead are.
struct PlacedOn {
  const Shape* shape;  ///< must outlive the manifold
  Pose pose;           ///< with which the points are on the body
  Vector3 outwards;    ///< unit; the normal of the contact, out of the body
};

/// The deepest point of an overlap and, if the bodies are flat, the manifold points: the `corners` of the region on which they
/// rest.
///
/// A flat body cannot rest on one exact point, because this point jumps from edge to edge as the body tilts by 1e-6 rad. So if both
/// bodies are flat at the contact, the manifold points span the intersection of their support polygons. There are up to four for a
/// face on a face, and two for a cylinder on its side. A round body has none, because it must roll and rock on the deepest point
/// alone.
///
/// All values are continuous functions of the pose. The manifold points move out of the deepest point as the bodies become flat
/// there. They are as deep as the deepest point, less the separation of the tilted faces, and at least 0. The size of the region
/// does not go to 0 with the depth, nor as the depth grows. lib/contact/theory.md has the construction and its
/// proofs.
struct ContactManifold {
  static constexpr int kMaxCorners = 4;  ///< the largest number of manifold points

  ContactManifold() = default;
  /// A single contact, without manifold points.
  ContactManifold(const Proximity& proximity) : deepest(proximity) {}  // NOLINT(google-explicit-constructor): one point is one

  Proximity deepest;                                  ///< the deepest point; the only contact if there are no manifold points
  std::array<ManifoldCorner, kMaxCorners> corners{};  ///< the first corner_count are valid, in order around the contact
  int corner_count = 0;                               ///< 0 or 4; some may be at the same place, see reduced_to()
  double same_place = 0;                              ///< m; manifold points that are nearer to each other count as one contact
  double margin = 0;                                  ///< m; at a manifold point the bodies are apart by at most this
  double reach = 0;                                   ///< m; a point with a larger gap is no contact
  /// m; a point this much above the deepest, or as far above it as the overlap is deep, has the least weight when two are merged
  double shallow = 0;
  std::optional<PlacedOn> placed_on;  ///< empty if the points are within both bodies, or between them
  int evaluations = 0;                ///< number of boundary points of one body that were evaluated for the manifold points
};

/// The manifold of two bodies with a known proximity. Only overlapping bodies have manifold points. These lie in the plane of
/// proximity.contact. The result is symmetric under swapping the bodies.
SUPERNORMAL_API ContactManifold find_contact_manifold(const Shape& shape1, const Pose& pose1, const Shape& shape2,
                                                      const Pose& pose2, const Proximity& proximity);

/// The manifold of a body and a plane; `proximity` comes from find_plane_proximity(). The manifold points are points of the body.
SUPERNORMAL_API ContactManifold find_plane_contact_manifold(const Shape& shape, const Pose& pose, const Proximity& proximity);

/// Reduces the manifold to at most `max_contacts` contacts. They are the manifold points at distinct places, deepest first, or the
/// deepest point if there are no manifold points. The first contact has the depth of the overlap. For two or three contacts,
/// neighbouring points are merged at a place between them, which is on the body of ContactManifold::placed_on. The result is as
/// continuous as the manifold.
SUPERNORMAL_API ContactManifold reduced_to(ContactManifold manifold, int max_contacts);

}  // namespace supernormal
