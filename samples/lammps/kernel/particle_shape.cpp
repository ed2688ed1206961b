#include "kernel/particle_shape.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace granular {

double bounding_radius(const Vector3& half_axes, double delta, double epsilon) {
  return farthest(farthest(half_axes.x(), half_axes.y(), delta), half_axes.z(), epsilon);
}

ParticleShape::ParticleShape(const Vector3& half_axes, double delta, double epsilon)
    : body(half_axes, delta, epsilon),
      bounding_radius(granular::bounding_radius(half_axes, delta, epsilon)),
      width(half_axes.mean()),
      least_half_axis(half_axes.minCoeff()),
      faces(find_faces(body)),
      sides(find_sides(body)) {
  const supernormal::MassProperties mass = body.mass_properties();
  volume = mass.volume;
  unit_inertia = mass.inertia().diagonal() / mass.volume;
  for (const Face& face : faces) {
    bulge = std::max(bulge, face.bulge);
    for (int k = 0; k < face.count; ++k) {
      bounding_radius = std::max(bounding_radius, std::hypot(face.height, face.vertices.at(static_cast<std::size_t>(k)).norm()));
    }
  }
  for (const Side& side : sides) {
    bulge = std::max(bulge, side.bulge);
    const double reach = side.across == side.along
                             ? std::hypot(farthest(half_axes.x(), half_axes.y(), delta), side.reach)
                             : farthest(std::hypot(half_axes[side.across], side.reach), half_axes.z(), epsilon);
    bounding_radius = std::max(bounding_radius, reach);
  }
}

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
