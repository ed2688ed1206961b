#include "kernel/particle_shape.hpp"

#include <algorithm>
#include <cmath>

namespace granular {
namespace {

/// The largest sqrt(x^2 + y^2) on |x/a|^e + |y/b|^e = 1. By Hoelder's inequality it is another norm of (a, b).
double farthest(double a, double b, double e) {
  const double longer = std::max(a, b);
  if (e <= 2) return longer;
  const double power = 2 * e / (e - 2);
  return longer * std::pow(1 + std::pow(std::min(a, b) / longer, power), 1 / power);
}

}  // namespace

double bounding_radius(const Vector3& half_axes, double delta, double epsilon) {
  return farthest(farthest(half_axes.x(), half_axes.y(), delta), half_axes.z(), epsilon);
}

ParticleShape::ParticleShape(const Vector3& half_axes, double delta, double epsilon)
    : body(half_axes, delta, epsilon),
      bounding_radius(granular::bounding_radius(half_axes, delta, epsilon)),
      width(half_axes.mean()),
      faces(find_faces(body)) {
  const supernormal::MassProperties mass = body.mass_properties();
  volume = mass.volume;
  unit_inertia = mass.inertia().diagonal() / mass.volume;
  for (const Face& face : faces) {
    bulge = std::max(bulge, face.bulge);
    for (int k = 0; k < face.count; ++k) {
      bounding_radius = std::max(bounding_radius, std::hypot(face.height, face.vertices.at(static_cast<std::size_t>(k)).norm()));
    }
  }
}

}  // namespace granular
