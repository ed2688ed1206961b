#include "contact/mesh/triangle_proximity.hpp"

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {

Proximity find_triangle_proximity(const Shape& shape, const Pose& pose, const std::array<Vector3, 3>& vertices,
                                  const Settings& settings, const Vector3* first_normal) {
  const Vector3 middle = (vertices[0] + vertices[1] + vertices[2]) / 3;
  const std::array<Vector3, 3> corners = {vertices[0] - middle, vertices[1] - middle, vertices[2] - middle};
  const Polytope triangle(corners);
  return find_proximity(shape, pose, triangle, {middle, Matrix3::Identity()}, settings, first_normal);
}

}  // namespace supernormal
