// Vectors of ODE.
#pragma once

#include <ode/ode.h>

#include "model/motion.hpp"

namespace falling_particles {

inline Vector3 to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }

}  // namespace falling_particles
