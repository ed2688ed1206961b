#include "wall.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {
namespace {

double radius_of(const PlaneShape& /*plane*/) { return INFINITY; }
double radius_of(const GroundShape& /*ground*/) { return INFINITY; }
double radius_of(const BoxShape& box) { return box.size.norm() / 2; }
double radius_of(const CylinderShape& cylinder) { return std::hypot(cylinder.radius, cylinder.length / 2); }
double radius_of(const SmoothShape& body) {
  const double widest = 1 + std::max(std::abs(body.taper_x), std::abs(body.taper_y));
  return Vector3(widest * body.half_axes.x(), widest * body.half_axes.y(), body.half_axes.z()).norm();
}
double radius_of(const MeshShape& mesh) {
  double radius = 0;
  for (const auto& [x, y, z] : mesh.vertices) radius = std::max(radius, Vector3(x, y, z).norm());
  return radius;
}

}  // namespace

double bounding_radius(const WallShape& shape) {
  return std::visit([](const auto& kind) { return radius_of(kind); }, shape);
}

}  // namespace falling_particles
