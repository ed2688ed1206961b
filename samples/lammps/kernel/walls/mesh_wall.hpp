// A wall of triangles.
#pragma once

#include <unsupported/Eigen/BVH>

#include "kernel/walls/wall.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace granular {

/// The space behind a triangle is solid (see MeshContacts).
class MeshWall final : public Wall {
 public:
  /// Triangles with their vertices anticlockwise from outside, m. Throws std::invalid_argument if there are none.
  explicit MeshWall(std::vector<supernormal::MeshTriangle> triangles);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  std::vector<supernormal::MeshTriangle> triangles_;
  Eigen::KdBVH<double, 3, int> tree_;  // indices of triangles_
  std::vector<supernormal::MeshTriangle> near_;
  supernormal::MeshContacts search_;
};

}  // namespace granular
