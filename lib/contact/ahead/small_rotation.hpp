// Prevents an impact at one end of a body from rotating it by a large angle within a step.
#pragma once

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal {

/// Moves the contacts of a manifold at the present poses in the tangent plane, towards the line through the centre of mass, as far
/// as needed to limit the rotation within `time`. `share` is the share of body 1 in the mobilities. The contacts stay on the
/// boundary of ContactManifold::placed_on: along the normal a place changes nothing but the lever arm of friction.
///
/// Contacts are linear in the motion, so they are valid for small rotations only. An impact with lever arm a stops the body at the
/// contact, but its centre keeps the fraction a^2 / (a^2 + k^2) of its velocity, with the radius of gyration k. If the displacement
/// is long compared to the body, the centre passes through the wall and the body rotates by many radians. With a shorter arm the
/// rotation is small and the body stops before the wall. The lost rotation could not be resolved at this step size.
///
/// Friction rotates a body as far as it does. If such a rotation would move the centre into the wall about a contact beside it, the
/// contact moves under the centre. If the middle of the body is off its centre of mass, the lever arm of friction is shorter: the
/// place is within the body.
void limit_rotation(const BodyAhead& body1, const BodyAhead& body2, double time, double share, ContactManifold& manifold);

/// Replaces the contact normal of two free bodies by the direction between their centres of mass, if the contact would rotate one
/// of them too far within `time`. A shift of the contact would not help, because no place in its tangent plane is in line with both
/// centres.
///
/// A contact between the centres rotates neither body. It stops the bodies where the distance of their centres along the new normal
/// equals the distance at the impact, after `meeting_time` (s). So the bodies do not pass each other. They lose part of the
/// sideways displacement, and the rotation.
void act_between_centres(const BodyAhead& body1, const BodyAhead& body2, double time, double share, double meeting_time,
                         ContactManifold& manifold);

}  // namespace supernormal
