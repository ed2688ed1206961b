// Keeps an impact at one end of a body from turning it by a large angle within a step.
#pragma once

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal {

/// Moves the contacts of a manifold at the poses of now along the tangent plane towards the line through the centre of mass, where
/// they would turn a body too far within `time`. `share` is that of body 1 in the motion of both.
///
/// Contacts are linear in the motion: they hold for small turns. An impact with the lever a stops that place of the body, and
/// leaves the centre the share a^2 / (a^2 + k^2) of its velocity, k the radius of gyration. Where the way is long beside the body,
/// that share takes the centre through a wall, and the body turns by many radians. With a lever so small that the turn is small,
/// the body stops before the wall. The turn that it has lost is one that no step of this length could follow.
void limit_turn(const BodyAhead& body1, const BodyAhead& body2, double time, double share, ContactManifold& manifold);

/// Gives a contact of two free bodies the normal from centre of mass to centre of mass, where it would turn one of them too far
/// within `time` wherever it acts in its tangent plane: no place there is in line with both centres.
///
/// Between the centres it turns neither body. It stops them where their centres, seen along that normal, are as far apart as when
/// they meet, after `meeting_time`. So they do not pass each other; what they lose is a part of the way aside, and the turn.
void act_between_centres(const BodyAhead& body1, const BodyAhead& body2, double time, double share, double meeting_time,
                         ContactManifold& manifold);

}  // namespace supernormal
