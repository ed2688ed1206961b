// The contact that keeps the centre of a body from going on while an impact at one end turns it.
#pragma once

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal {

/// Adds the contact at the centre to a manifold at the poses of now, where the centres would come nearer than it allows within
/// `time`. `share` is that of body 1 in the motion of both.
///
/// Contacts are linear in the motion: they hold for small turns. An impact with the lever a that stops one end of a body lets its
/// centre go on, and turns it by the way of the centre over a. So the centre may come nearer than the contacts do by a times a
/// small angle, and the turn that the body is in already, and no more: then a step ends before the turn is large, and the next one
/// finds what comes down on the other side. At any attitude the centre is no nearer to the plane than half of the smallest
/// half-extent.
void hold_centre(const MovingBody& body1, const MovingBody& body2, double time, double share, ContactManifold& manifold);

}  // namespace supernormal
