// A superellipsoid with what a particle simulation asks of it at every step.
#pragma once

#include "supernormal/shapes/superellipsoid.hpp"

namespace granular {

using supernormal::Vector3;

/// The body of particles of one size and kind.
struct ParticleShape {
  /// Half-axes in m and exponents as Superellipsoid takes them; std::invalid_argument otherwise.
  ParticleShape(const Vector3& half_axes, double delta, double epsilon);

  supernormal::Superellipsoid body;
  double bounding_radius;  ///< m; the farthest that a point of the body is from its centre
  double width;            ///< m; the mean half-axis
  double volume;           ///< m^3
  Vector3 unit_inertia;    ///< m^2; principal moments of inertia over the mass, along the axes of the body
};

/// The distance (m) of the farthest point of a superellipsoid from its centre.
double bounding_radius(const Vector3& half_axes, double delta, double epsilon);

}  // namespace granular
