// How a body turns that nothing acts on.
#pragma once

#include <Eigen/Geometry>

namespace granular {

/// The attitude (body to world) after `step` (s) of a body with constant angular momentum (kg m^2/s, world frame) and the given
/// principal moments of inertia (kg m^2) along the axes of its frame: five turns about these axes (Dullweber, Leimkuhler and
/// McLachlan, J. Chem. Phys. 107, 5840 (1997)), symplectic and of second order, so that the energy does not drift.
Eigen::Quaterniond rotate_freely(const Eigen::Quaterniond& attitude, const Eigen::Vector3d& angular_momentum,
                                 const Eigen::Vector3d& inertia, double step);

}  // namespace granular
