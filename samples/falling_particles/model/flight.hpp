// The inertia of a wall that moves freely.
#pragma once

#include "common/motion.hpp"

namespace falling_particles {

using namespace common;

/// A wall that is free in all six degrees of freedom. Its weight and the forces of its contacts move it.
struct Flight {
  double mass = 0;                                    ///< kg
  Vector3 centre = Vector3::Zero();                   ///< m, of mass, in the wall's frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m^2, about the centre, in the wall's frame
  WallVelocity velocity = {};                         ///< of the centre of mass, when the flight starts
  double from = 0;                                    ///< s; until then the wall is held
};

}  // namespace falling_particles
