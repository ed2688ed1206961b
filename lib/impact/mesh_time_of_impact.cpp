#include "supernormal/impact/mesh_time_of_impact.hpp"

#include <array>

#include "impact/usable_motion.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

/// A triangle about its middle, where the solvers of the gap start.
struct MovingTriangle {
  std::array<Vector3, 3> vertices;
  Motion motion;

  MovingTriangle(const MeshTriangle& triangle, const Motion& mesh_motion) : vertices(triangle.vertices), motion(mesh_motion) {
    const Vector3 middle = (vertices[0] + vertices[1] + vertices[2]) / 3;
    for (Vector3& vertex : vertices) vertex -= middle;
    motion.pose.position += motion.pose.rotation * middle;
    motion.centre -= middle;
  }
};

bool is_first(const Impact& one, const Impact& other) {
  if (one.may_hit() != other.may_hit()) return one.may_hit();
  return one.may_hit() ? one.time < other.time : one.proximity.gap < other.proximity.gap;
}

}  // namespace

MeshImpact find_mesh_time_of_impact(const Shape& shape, const Motion& motion, std::span<const MeshTriangle> triangles,
                                    const Motion& mesh_motion, double horizon, const Settings& settings) {
  require_usable(horizon, settings);
  if (!is_usable(motion, horizon) || !is_usable(mesh_motion, horizon)) return {};
  MeshImpact first;
  first.impact.status = ImpactStatus::Apart;
  first.impact.time = first.impact.apart_until = horizon;
  int evaluations = 0;
  bool is_empty = true;
  for (const MeshTriangle& triangle : triangles) {
    const MovingTriangle moving(triangle, mesh_motion);
    const Impact impact = find_time_of_impact(shape, motion, Polytope(moving.vertices), moving.motion, first.impact.time, settings);
    if (impact.status == ImpactStatus::InvalidInput) return {};
    evaluations += impact.evaluations;
    if (is_empty || is_first(impact, first.impact)) first = {impact, impact.may_hit() ? triangle.index : -1};
    is_empty = false;
  }
  first.impact.evaluations = evaluations;
  return first;
}

}  // namespace supernormal
