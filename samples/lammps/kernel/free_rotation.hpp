// The rotation of a free body.
#pragma once

#include <Eigen/Geometry>

namespace granular {

/// The orientation (body to world) after `step` (s) of a body with constant angular momentum (kg m^2/s, world frame). `inertia`:
/// principal moments (kg m^2) along the axes of its frame. The step consists of five rotations about these axes (Dullweber,
/// Leimkuhler and McLachlan, J. Chem. Phys. 107, 5840 (1997)). It is symplectic and of second order, so the energy does not drift.
Eigen::Quaterniond rotate_freely(const Eigen::Quaterniond& orientation, const Eigen::Vector3d& angular_momentum,
                                 const Eigen::Vector3d& inertia, double step);

}  // namespace granular
