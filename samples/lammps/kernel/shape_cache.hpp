// The shapes of many particles, each created once.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <unordered_map>

#include "kernel/particle_shape.hpp"

namespace granular {

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
