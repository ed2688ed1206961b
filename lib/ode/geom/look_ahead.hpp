// Contacts before overlap: the default look-ahead time, and the motion of geoms.
#pragma once

#include <ode/ode.h>

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal::ode {

/// The look_ahead() of new bodies, s. Thread-safe.
double default_look_ahead();
void set_default_look_ahead(double time);

/// The acceleration of a body by gravity and by the forces added since the last step, m/s^2.
Vector3 acceleration_of(dBodyID body, const dMass& mass);

/// The motion of a geom in the next `time` (s, a step) about its point `origin` (m, world frame), which is within `radius` (m) of
/// all its points. Without `time` it has no angular acceleration. A geom without a body rests, and so does one with a disabled
/// body.
MotionAhead motion_ahead_of(dGeomID geom, const Vector3& origin, double radius, double time = 0);

/// Whether a geom of the contact is ours and looks ahead.
bool looks_ahead(const dContactGeom& contact);

/// Lets a contact correct most of its overlap in each step, if the program has not chosen its ERP. Contacts of geoms that look
/// ahead overlap by what the solver left over, so the correction throws nothing apart.
void correct_leftover(dSurfaceParameters& surface);

}  // namespace supernormal::ode
