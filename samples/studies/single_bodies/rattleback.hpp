// The rattleback of Kane and Levinson (Realistic mathematical modeling of the rattleback, Int. J. Non-Linear Mechanics 17, 1982).
// It is an ellipsoid that begins to rattle and reverses if it is spun against its preferred sense. The rattling grows from a tilt
// of half a degree, so it magnifies an error of the contact point or a damping in it.
#pragma once

#include <ode/ode.h>

namespace single_bodies {

/// Half-axes 0.2, 0.03, 0.02 m, the centre of mass 0.01 m below the ellipsoid's centre. The orientation is R_x(alpha) R_y(beta)
/// R_z(yaw).
class Rattleback {
 public:
  /// Releases it on the plane z = 0 at alpha = beta = 0.5 degrees with a spin (rad/s) about its third axis, with the contact point
  /// at rest. The world keeps the body, the space the geom; both must outlive this object. Throws std::runtime_error if the library
  /// refuses it.
  Rattleback(dWorldID world, dSpaceID space, double spin);

  /// Updates the yaw. Call it after every step.
  void follow();

  dBodyID body() const { return body_; }
  double spin() const;                 ///< rad/s, about the third axis
  double yaw() const { return yaw_; }  ///< rad; from 0 at the start, including full turns

 private:
  dBodyID body_;
  double yaw_ = 0;
};

}  // namespace single_bodies
