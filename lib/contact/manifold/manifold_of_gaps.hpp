// The manifold by gaps for bodies of which it is known by how much they may turn.
#pragma once

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal {

// Tilt of the normal, radians: a corner is where the body touches a plane that leans by this much. A body that turns by less
// within the time ahead comes down on what lies between its corners. From 0.05 to 0.2 bodies rest alike; with 0.02 coins topple,
// since what comes down lies outside.
inline constexpr double kLeastTilt = 0.1;

/// find_manifold_of_gaps() and find_plane_manifold_of_gaps() with the corners of another tilt (radians, > 0).
ContactManifold find_manifold_of_tilt(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                      const Proximity& proximity, double share, double tilt);
ContactManifold find_plane_manifold_of_tilt(const Shape& shape, const Pose& pose, const Proximity& proximity, double tilt);

}  // namespace supernormal
