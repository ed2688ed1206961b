// Contacts ahead: contacts of bodies that are about to meet, before they overlap.
#pragma once

#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The manifold of two bodies that are apart, touch or overlap slightly. Its points span the region on which the bodies would rest.
/// Each has the gap that is left there.
///
/// `approach` (m) is the overlap that would form in the step without contact forces. The manifold points are those of an overlap of
/// this depth, find_contact_manifold(). Bodies that do not move bear on them, on inclines as steep as their closed forms say. The
/// more they move, the farther out they may land. The faces count as flat between the manifold points. The gap of a point is the
/// bodies' gap plus the separation of the tilted faces. A point far above the floor is no false support, if the solver for the
/// forces knows its gap: the gap may close, and no more.
///
/// The depth of a point is minus its gap, which is negative where the bodies are apart. `share` in [0, 1] sets the place of the
/// contacts along the normal, between the two boundaries: 1 is on body 1, 0 on body 2. Use body 1's fraction of the motion, the
/// inverse of its mass over the sum of both inverses. At 1 and 0 the manifold points are on the boundary of this body. Other places
/// in a wide gap would give a force a lever arm that it does not have when the bodies touch. The result is symmetric under swapping
/// the bodies. reduced_to() sorts the points by increasing gap.
SUPERNORMAL_API ContactManifold find_manifold_of_gaps(const Shape& shape1, const Pose& pose1, const Shape& shape2,
                                                      const Pose& pose2, const Proximity& proximity, double share,
                                                      double approach = 0);

/// The same for a body and a plane; `proximity` comes from find_plane_proximity(). The contacts are on the body, as for a
/// share of 1.
SUPERNORMAL_API ContactManifold find_plane_manifold_of_gaps(const Shape& shape, const Pose& pose, const Proximity& proximity,
                                                            double approach = 0);

/// The expected motion of a body.
struct MotionAhead {
  Vector3 velocity = Vector3::Zero();          ///< m/s; of the origin of the body's frame
  Vector3 centre = Vector3::Zero();            ///< m; the centre of mass, in the frame that the pose refers to
  Matrix3 turning = Matrix3::Zero();           ///< 1/m^2; the mass times the inverse of the inertia tensor, in the same frame
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s; in the same frame
  Vector3 acceleration = Vector3::Zero();      ///< m/s^2; by gravity and known forces
  /// rad/s^2; by known torques, and of a body that rotates about no principal axis; constant in the time looked ahead
  Vector3 angular_acceleration = Vector3::Zero();
  double arm = 0;                    ///< m; an upper bound on the distance of the body's points from the centre of rotation
  bool turns_along_tangent = false;  ///< a step turns the body by 2 atan(angle / 2), as ODE does without finite rotation
  double mobility = 0;               ///< 1/kg; the inverse of the mass; 0 for a body that does not move under a force
};

/// m; how much nearer to another body a body may come within `time` (s) than its velocity predicts. Rotation and forces contribute,
/// and a push of one hundredth of `size` (the body's smallest half-extent, m). Two bodies are examined if they come nearer than the
/// sum of their values.
SUPERNORMAL_API double nearness(const MotionAhead& motion, double time, double size);

/// m; the distance within which a body may meet a plane within `time` (s). `direction` is the plane's unit normal, towards the
/// plane. `size` (m) is the body's smallest half-extent.
SUPERNORMAL_API double reach_towards(const MotionAhead& motion, const Vector3& direction, double time, double size);

/// A moving body.
struct BodyAhead {
  const Shape& shape;  ///< must outlive this object
  Pose pose;           ///< at present
  MotionAhead motion;  ///< from now on
};

/// The contacts of two bodies that may meet within `time` (s, positive and finite), by their motion or by a push.
///
/// The function moves the bodies along their velocities, without rotation, to where they would meet. It finds the manifold there,
/// and transforms the gaps and places back to the present poses. So a body that flies past an edge has no contact with it, even if
/// the present tangent planes are in its way. `now` is the proximity of the two bodies at their poses, with settings that do not
/// stop when the bodies are apart. lib/contact/theory.md has the construction.
///
/// Gravity bends the path of a body, and rotation the paths of its points. If such a contact would hold back bodies that do not
/// meet within the time, by their velocities and rotations after the accelerations, the contacts are those at the end of
/// this motion. They leave it as it is.
///
/// An impact might rotate a body by a large angle within the time. Such a contact is moved towards the line through the centre of
/// mass, so that the rotation is small. The reason is that contacts are linear in the motion: a contact at the end of a body would
/// let its centre pass through a wall.
///
/// The contacts have gaps up to ContactManifold::reach; Status::Apart if there are none. If the motion leads out of the range of
/// poses, the result is the manifold at the present poses. If a motion is not finite, both bodies count as standing still.
SUPERNORMAL_API ContactManifold find_contacts_ahead(const BodyAhead& body1, const BodyAhead& body2, double time,
                                                    const Settings& settings, const Proximity& now);

/// The same for a body and a plane at rest; `now` comes from find_plane_proximity(). No further query is needed.
SUPERNORMAL_API ContactManifold find_plane_contacts_ahead(const BodyAhead& body, double time, const Proximity& now);

}  // namespace supernormal
