// A kind of grain.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry.hpp"

namespace falling_particles {

/// A convex body of the given outer size, its edges rounded by a sphere that rolls inside.
struct ConvexBody {
  enum class Shape { Superellipsoid, Superovoid, Capsule };

  std::array<double, 3> half_axes;  ///< m, along the body's x, y, z; rounding included; of a capsule the axis is z
  double delta = 2;                 ///< exponent of the xy-section
  double epsilon = 2;               ///< exponent along z
  double rounding = 0;              ///< m, radius; 0: none
  Shape shape = Shape::Superellipsoid;
  std::array<double, 2> taper = {};  ///< of a superovoid, along x and y

  double smallest_half_axis() const;
  /// m; of the body that the sphere of the rounding sweeps.
  std::array<double, 3> core_half_axes() const;
  /// m; the radius of a sphere about the origin that holds the body: of the smallest one unless it is a superovoid.
  double bounding_radius() const;
};

/// A body of a compound, in its place.
struct Component {
  ConvexBody body;
  double density;                                   ///< kg/m^3
  Point position = {};                              ///< m, of the body's origin, in the grain's frame
  std::array<double, 4> quaternion = {1, 0, 0, 0};  ///< w, x, y, z; unit: from the body's frame to the grain's
};

/// The mass of a compound, about its centroid and along the axes of its frame.
struct CompoundMass {
  double mass;                                   ///< kg
  std::array<std::array<double, 3>, 3> inertia;  ///< kg m^2
};

/// A kind of grain: one convex body, or several in fixed places. The origin of its frame is its centre of mass.
struct GrainKind {
  std::string name;
  std::array<double, 3> half_axes;  ///< m, along the grain's x, y, z; rounding included; of a compound, of the box around it
  double delta;                     ///< exponent of the xy-section
  double epsilon;                   ///< exponent along z
  double rounding;                  ///< m, radius; 0: none
  double density;                   ///< kg/m^3; of a compound the mean
  std::string source;               ///< where the dimensions come from; "typical" when there is no published source
  bool is_capsule = false;
  std::vector<Component> components = {};          ///< of a compound; none for one convex body
  std::optional<CompoundMass> compound_mass = {};  ///< of a compound

  /// The parts of a compound, or the one body.
  std::vector<Component> all_components() const;

  double smallest_half_axis() const;  ///< m; of a compound, of its parts
  /// m; the radius of a sphere about the centre that holds the grain: of the smallest one unless it is a compound.
  double bounding_radius() const;
  /// m; the middle one of the widths along x, y and z: the opening of the sieve that the grain just passes lengthwise.
  double sieve_size() const;
};

}  // namespace falling_particles
