#include "contact/triangle_proximity.hpp"

#include <Eigen/Geometry>
#include <span>

#include "supernormal/shapes/polytope.hpp"
#include "supernormal/solvers/solve.hpp"

namespace supernormal {

Proximity find_triangle_proximity(const Shape& shape, const Pose& pose, const std::array<Vector3, 3>& vertices,
                                  const Settings& settings, const Vector3* first_normal) {
  const Vector3 middle = (vertices[0] + vertices[1] + vertices[2]) / 3;
  const std::array<Vector3, 3> corners = {vertices[0] - middle, vertices[1] - middle, vertices[2] - middle};
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const std::array<Vector3, 2> face_normals = {normal, -normal};
  const std::size_t normal_count = normal.isZero(0) ? 0 : 2;  // none for three points on a line
  const Polytope triangle(corners, std::span(face_normals).first(normal_count));
  return find_proximity(shape, pose, triangle, {middle, Matrix3::Identity()}, settings, first_normal);
}

}  // namespace supernormal
