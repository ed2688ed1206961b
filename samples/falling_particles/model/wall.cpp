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

/// A face and its unit normal, towards the grains.
struct Face {
  Vector3 normal;
  Vector3 point;  // m
};

std::vector<Face> faces_of(const WallShape& shape, const WallPose& pose) {
  if (const auto* plane = std::get_if<PlaneShape>(&shape)) return {{pose.rotation * plane->normal, pose.position}};
  std::vector<Face> faces;
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vector3 normal = pose.rotation * Vector3::Unit(axis);
      for (const double side : {-1.0, 1.0}) faces.push_back({side * normal, pose.position + side * box->size[axis] / 2 * normal});
    }
  }
  return faces;
}

}  // namespace

double bounding_radius(const WallShape& shape) {
  return std::visit([](const auto& kind) { return radius_of(kind); }, shape);
}

std::optional<FacingFaces> facing_faces(const WallShape& first, const WallPose& at_first, const WallShape& second,
                                        const WallPose& at_second) {
  constexpr double kParallel = 1e-9;  // of the product of two unit normals: rounding of poses
  std::optional<FacingFaces> found;
  for (const Face& one : faces_of(first, at_first)) {
    for (const Face& two : faces_of(second, at_second)) {
      if (one.normal.dot(two.normal) > kParallel - 1) continue;
      const FacingFaces faces{one.normal, one.normal.dot(one.point), one.normal.dot(two.point)};
      if (!found || faces.distance() > found->distance()) found = faces;
    }
  }
  return found;
}

}  // namespace falling_particles
