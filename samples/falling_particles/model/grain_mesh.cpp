#include "grain_mesh.hpp"

#include "grain_shape.hpp"

namespace falling_particles {

supernormal::Tessellation mesh_of(const GrainKind& kind, double chord_error) {
  supernormal::Tessellation mesh;
  for (const Component& component : kind.all_components()) {
    supernormal::Tessellation body = tessellate(*shape_of(component.body), chord_error * component.body.smallest_half_axis());
    if (kind.components.empty()) return body;
    const supernormal::Pose pose = pose_of(component);
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const auto& point : body.points) mesh.points.emplace_back(pose.rotation * point + pose.position);
    for (const auto& normal : body.normals) mesh.normals.emplace_back(pose.rotation * normal);
    for (const auto& [a, b, c] : body.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

}  // namespace falling_particles
