// A wall of triangles.
#pragma once

#include <unsupported/Eigen/BVH>

#include "kernel/walls/wall.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace granular {

/// Behind a triangle is solid (MeshContacts).
class MeshWall final : public Wall {
 public:
  /// Triangles with their vertices anticlockwise as seen from outside, m; std::invalid_argument without any.
  explicit MeshWall(std::vector<supernormal::MeshTriangle> triangles);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  std::vector<supernormal::MeshTriangle> triangles_;
  Eigen::KdBVH<double, 3, int> tree_;  // of indices of triangles_
  std::vector<supernormal::MeshTriangle> near_;
  supernormal::MeshContacts search_;
};

}  // namespace granular
