// A superellipsoid with the quantities that a particle simulation needs at every step, and the rotation of a free one.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "kernel/face.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace granular {

/// The shape of all particles of one size and kind.
struct ParticleShape {
  /// Half-axes (m) and exponents must be valid for Superellipsoid. Throws std::invalid_argument otherwise.
  ParticleShape(const Vector3& half_axes, double delta, double epsilon);

  supernormal::Superellipsoid body;
  double bounding_radius;  ///< m; largest distance of a point of the body, of a face or of a side, from its centre
  double width;            ///< m; the mean half-axis
  double least_half_axis;  ///< m
  double volume;           ///< m^3
  Vector3 unit_inertia;    ///< m^2; principal moments of inertia over the mass, along the axes of the body
  std::vector<Face> faces;
  std::vector<Side> sides;
  double bulge = 0;  ///< m; no face and no side sticks out of the body by more than this

  /// The half-axes (m) of the ellipsoid with the same mass and inertia.
  Vector3 equal_ellipsoid() const { return (2.5 * (unit_inertia.sum() - 2 * unit_inertia.array())).sqrt(); }
};

/// The largest distance of a point of a superellipsoid from its centre, m.
double bounding_radius(const Vector3& half_axes, double delta, double epsilon);

/// The orientation (body to world) after `step` (s) of a body with constant angular momentum (kg m^2/s, world frame). `inertia`:
/// principal moments (kg m^2) along the axes of its frame. The step consists of five rotations about these axes (Dullweber,
/// Leimkuhler and McLachlan, J. Chem. Phys. 107, 5840 (1997)). It is symplectic and of second order, so the energy does not drift.
Eigen::Quaterniond rotate_freely(const Eigen::Quaterniond& orientation, const Vector3& angular_momentum, const Vector3& inertia,
                                 double step);

}  // namespace granular
