// A superellipsoid with the quantities that a particle simulation needs at every step, and a store of such shapes.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <unordered_map>

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

/// Owns shapes. Their addresses are valid until clear().
class ShapeCache {
 public:
  /// The shape with these half-axes (m) and exponents. Throws std::invalid_argument like Superellipsoid.
  const ParticleShape& find(const Vector3& half_axes, double delta, double epsilon);

  std::size_t size() const { return shapes_.size(); }
  void clear() { shapes_.clear(); }

 private:
  using Key = std::array<double, 5>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  std::unordered_map<Key, std::unique_ptr<const ParticleShape>, Hash> shapes_;
};

}  // namespace granular
