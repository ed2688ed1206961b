#include "kernel/shape_cache.hpp"

#include <functional>

namespace granular {

std::size_t ShapeCache::Hash::operator()(const Key& key) const {
  std::size_t hash = 0;
  for (const double value : key) hash = 31 * hash + std::hash<double>()(value);
  return hash;
}

const ParticleShape& ShapeCache::find(const Vector3& half_axes, double delta, double epsilon) {
  const Key key = {half_axes.x(), half_axes.y(), half_axes.z(), delta, epsilon};
  const auto known = shapes_.find(key);
  if (known != shapes_.end()) return *known->second;
  return *shapes_.emplace(key, std::make_unique<const ParticleShape>(half_axes, delta, epsilon)).first->second;
}

}  // namespace granular
