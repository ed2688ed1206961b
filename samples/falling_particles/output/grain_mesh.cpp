#include "grain_mesh.hpp"

#include "model/grain_shape.hpp"

namespace falling_particles {

supernormal::Tessellation mesh_of(const Grain& grain, double chord_error) {
  supernormal::Tessellation mesh;
  for (const GrainPart& part : grain.all_parts()) {
    supernormal::Tessellation body = tessellate(*shape_of(part.body), chord_error * part.body.smallest_half_axis());
    if (grain.parts.empty()) return body;
    const supernormal::Pose pose = pose_of(part);
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const auto& point : body.points) mesh.points.emplace_back(pose.rotation * point + pose.position);
    for (const auto& normal : body.normals) mesh.normals.emplace_back(pose.rotation * normal);
    for (const auto& [a, b, c] : body.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

}  // namespace falling_particles
