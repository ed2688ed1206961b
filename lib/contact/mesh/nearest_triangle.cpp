#include <algorithm>
#include <array>
#include <limits>

#include "contact/mesh/mesh_triangle.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

/// The last evaluated supporting planes of the body. A triangle beyond one of them is at least that far away.
class SupportingPlanes {
 public:
  void add(const Vector3& normal, double offset) {
    planes_[count_ % planes_.size()] = {normal, offset};
    ++count_;
  }

  /// A lower bound of the gap to the triangle.
  double distance(const MeshTriangle& triangle) const {
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < std::min(count_, planes_.size()); ++i) {
      const Plane& plane = planes_[i];
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3& vertex : triangle.vertices) least = std::min(least, plane.normal.dot(vertex) - plane.offset);
      largest = std::max(largest, least);
    }
    return largest;
  }

 private:
  struct Plane {
    Vector3 normal;  // from the body to the surface
    double offset;
  };

  std::array<Plane, 8> planes_;
  std::size_t count_ = 0;
};

const MeshTriangle* nearest_to(const Vector3& point, std::span<const MeshTriangle> triangles) {
  const MeshTriangle* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const MeshTriangle& triangle : triangles) {
    if (!is_usable(triangle)) continue;
    for (const Vector3& vertex : triangle.vertices) {
      const double squared = (vertex - point).squaredNorm();
      if (squared >= least) continue;
      least = squared;
      nearest = &triangle;
    }
  }
  return nearest;
}

}  // namespace

Proximity find_triangle_proximity(const Shape& shape, const Pose& pose, const std::array<Vector3, 3>& vertices,
                                  const Settings& settings, const Vector3* first_normal) {
  const Vector3 middle = (vertices[0] + vertices[1] + vertices[2]) / 3;
  const std::array<Vector3, 3> corners = {vertices[0] - middle, vertices[1] - middle, vertices[2] - middle};
  const Polytope triangle(corners);
  return find_proximity(shape, pose, triangle, {middle, Matrix3::Identity()}, settings, first_normal);
}

MeshContact find_nearest_triangle(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles,
                                  const Settings& settings) {
  SupportingPlanes planes;
  MeshContact nearest;
  int evaluations = 0;
  const auto attempt = [&](const MeshTriangle& triangle) {
    const Proximity found = find_triangle_proximity(shape, pose, triangle.vertices, settings);
    evaluations += found.evaluations;
    if (found.status == Status::InvalidInput) return;
    planes.add(found.normal, found.normal.dot(pose.position) + shape.support(pose.rotation.transpose() * found.normal));
    if (nearest.proximity.status == Status::InvalidInput || found.gap < nearest.proximity.gap) nearest = {found, triangle.index};
  };
  const MeshTriangle* const first = nearest_to(pose.position, triangles);
  if (first == nullptr) return nearest;
  attempt(*first);
  for (const MeshTriangle& triangle : triangles) {
    if (&triangle == first || !is_usable(triangle)) continue;
    if (nearest.proximity.status == Status::InvalidInput || planes.distance(triangle) < nearest.proximity.gap) attempt(triangle);
  }
  nearest.proximity.evaluations = evaluations;
  return nearest;
}

}  // namespace supernormal
