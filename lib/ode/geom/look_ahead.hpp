// Contacts before overlap: the default time, and how geoms move.
#pragma once

#include <ode/ode.h>

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal::ode {

/// s; look_ahead() of bodies that are created from now on. Any thread may read and set it.
double default_look_ahead();
void set_default_look_ahead(double time);

/// m/s^2; what gravity and the forces that were added since the last step do to a body of this mass.
Vector3 acceleration_of(dBodyID body, const dMass& mass);

/// The motion of a geom, about the point `origin` (m, world frame) of it, beyond which it reaches by no more than `radius` (m). A
/// geom without a body stands still, and so does one whose body sleeps.
MotionAhead motion_ahead_of(dGeomID geom, const Vector3& origin, double radius);

}  // namespace supernormal::ode
