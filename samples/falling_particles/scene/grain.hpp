// A kind of grain.
#pragma once

#include <array>
#include <string>

namespace falling_particles {

/// A kind of grain: a superellipsoid of the given outer size, its edges rounded by a sphere that rolls inside.
struct Grain {
  std::string name;
  std::array<double, 3> half_axes;  ///< m, along the body's x, y, z; rounding included
  double delta;                     ///< exponent of the xy-section
  double epsilon;                   ///< exponent along z
  double rounding;                  ///< m, radius; 0: none
  double density;                   ///< kg/m^3
  std::string source;               ///< where the dimensions come from; "typical" when there is no published source

  double smallest_half_axis() const;
  /// m; of the superellipsoid that the sphere of the rounding sweeps.
  std::array<double, 3> core_half_axes() const;
  /// m; the radius of the smallest sphere about the centre that holds the grain.
  double bounding_radius() const;
};

}  // namespace falling_particles
