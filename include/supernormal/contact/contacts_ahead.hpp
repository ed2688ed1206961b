// Contacts of bodies that are about to meet, found before they overlap.
#pragma once

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Radians; the tilt of the corners of bodies that hardly turn. From 0.05 to 0.2 bodies rest alike; with 0.02 coins topple, since
/// what comes down lies outside of its corners.
inline constexpr double kLeastTilt = 0.1;

/// The manifold of two bodies that are apart, touch or overlap slightly, by their gaps: the corners of the region on which they
/// would rest, each with the gap that is left there.
///
/// The support polygon of each body is that of one tilt (radians, > 0), whatever the gap: a corner is where the body touches a
/// plane that leans by it, and a body that turns by less comes down on what lies between its corners. In the region that the
/// polygons have in common the faces count as flat, and what they lean away from one another is the gap of a corner beyond the gap
/// of the bodies. A corner far above the floor is no false support as long as its gap is known to whoever solves for the forces: it
/// may close, and no more.
///
/// A corner's depth is minus its gap, so that it is negative where the bodies are apart. `share` in [0, 1] tells where between the
/// two boundaries the contacts are, along the normal: on body 1 if it is 1, on body 2 if it is 0. Take the share that body 1 has in
/// the motion, the inverse of its mass over the sum of both: in the middle of a wide gap a force has a lever that it never gets.
/// The result is symmetric under swapping the bodies. reduced_to() sorts the corners by rising gap.
SUPERNORMAL_API ContactManifold find_manifold_of_gaps(const Shape& shape1, const Pose& pose1, const Shape& shape2,
                                                      const Pose& pose2, const Proximity& proximity, double share,
                                                      double tilt = kLeastTilt);

/// The same for a body and a plane, from find_plane_proximity(); the contacts are points of the body.
SUPERNORMAL_API ContactManifold find_plane_manifold_of_gaps(const Shape& shape, const Pose& pose, const Proximity& proximity,
                                                            double tilt = kLeastTilt);

/// What is known of a body's motion in the time to come.
struct MotionAhead {
  Vector3 velocity = Vector3::Zero();          ///< m/s; of the origin of the body's frame
  Vector3 centre = Vector3::Zero();            ///< m; the centre of mass, in the frame that the pose refers to
  Matrix3 turning = Matrix3::Zero();           ///< 1/m^2; the inverse of the inertia tensor times the mass, in the same frame
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s; in the same frame
  double arm = 0;                              ///< m; no point of the body is farther from what it turns about
  double acceleration = 0;                     ///< m/s^2; the most that gravity and known forces change the velocity
  double mobility = 0;                         ///< 1/kg; the inverse of the mass, 0 for a body that does not yield
};

/// How much nearer to another body than its velocity says a body may come within `time` (s), m: by rotation, by forces, and by a
/// push of one hundredth of its `size` (its smallest half-extent, m). Two bodies are looked at that come as near as the sum of
/// both.
SUPERNORMAL_API double nearness(const MotionAhead& motion, double time, double size);

/// How near to a body a plane across `direction` (unit, towards the plane) must be, for the body to meet it within `time` (s), m.
SUPERNORMAL_API double reach_towards(const MotionAhead& motion, const Vector3& direction, double time, double size);

/// A body that moves.
struct BodyAhead {
  const Shape& shape;  ///< what it refers to must live as long
  Pose pose;           ///< of now
  MotionAhead motion;  ///< from now on
};

/// The contacts of two bodies that may meet within `time` (s, positive and finite), or that a push may bring together in it.
///
/// The bodies are moved along their velocities, without rotation, to where they would be when they met; there the manifold is
/// found, and its gaps and places are taken back to the poses of now. So a body that flies past an edge has no contact with it,
/// though the tangent planes of now are in its way. `now` is the proximity of the two at their poses, with settings that do not
/// stop where the bodies are apart. lib/contact/README.md has the construction.
///
/// An impact that would turn a body by a large angle within the time acts nearer to the line through its centre of mass, so that
/// the turn is small: contacts are linear in the motion, and one at the end of a body would let the centre go on through a wall.
///
/// Contacts are those with a gap up to ContactManifold::reach; Status::Apart if there are none. Where the bodies are moved out of
/// the range of poses, the manifold is that of the poses of now. Where a motion is not finite, both count as standing still.
SUPERNORMAL_API ContactManifold find_contacts_ahead(const BodyAhead& body1, const BodyAhead& body2, double time,
                                                    const Settings& settings, const Proximity& now);

/// The same for a body and a plane that stands still; `now` is from find_plane_proximity(). No query is needed beyond that.
SUPERNORMAL_API ContactManifold find_plane_contacts_ahead(const BodyAhead& body, double time, const Proximity& now);

}  // namespace supernormal
