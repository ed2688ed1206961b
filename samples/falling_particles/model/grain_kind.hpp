// A kind of grain.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry.hpp"

namespace falling_particles {

/// A convex body of the given outer size. Its edges are rounded by a sphere that rolls inside.
struct ConvexBody {
  enum class Shape { Superellipsoid, Superovoid, Capsule };

  std::array<double, 3> half_axes;  ///< m, along the body's x, y, z, rounding included; the axis of a capsule is z
  double delta = 2;                 ///< exponent of the xy-section
  double epsilon = 2;               ///< exponent along z
  double rounding = 0;              ///< m, radius; 0: none
  Shape shape = Shape::Superellipsoid;
  std::array<double, 2> taper = {};  ///< of a superovoid, along x and y

  double smallest_half_axis() const;
  /// m, half-axes of the core, over which the centre of the rounding sphere moves.
  std::array<double, 3> core_half_axes() const;
  /// m, radius of a sphere about the origin that contains the body. It is the smallest one, except for a superovoid.
  double bounding_radius() const;
};

/// A component of a compound.
struct Component {
  ConvexBody body;
  double density;                                   ///< kg/m^3
  Point position = {};                              ///< m, origin of the body in the grain's frame
  std::array<double, 4> quaternion = {1, 0, 0, 0};  ///< w, x, y, z; unit: from the body's frame to the grain's
};

/// The mass and inertia of a compound about its centroid, along the axes of its frame.
struct CompoundMass {
  double mass;                                   ///< kg
  std::array<std::array<double, 3>, 3> inertia;  ///< kg m^2
};

/// A kind of grain: one convex body, or several in fixed places. The centre of mass is the origin of its frame.
struct GrainKind {
  std::string name;
  std::array<double, 3> half_axes;  ///< m, along x, y, z, rounding included; of a compound, of its bounding box
  double delta;                     ///< exponent of the xy-section
  double epsilon;                   ///< exponent along z
  double rounding;                  ///< m, radius; 0: none
  double density;                   ///< kg/m^3; of a compound, the mean
  std::string source;               ///< the source of the dimensions; "typical" without a published source
  bool is_capsule = false;
  std::vector<Component> components = {};          ///< of a compound; empty for one convex body
  std::optional<CompoundMass> compound_mass = {};  ///< of a compound

  /// The components of a compound, or the single body.
  std::vector<Component> all_components() const;

  double smallest_half_axis() const;  ///< m; of a compound, the smallest one of its components
  /// m, radius of a sphere about the centre that contains the grain; the smallest one unless it is a compound.
  double bounding_radius() const;
  /// m, the middle one of the widths along x, y and z. A grain just passes a sieve with this opening lengthwise.
  double sieve_size() const;
};

}  // namespace falling_particles
