// A wall of triangles.
#pragma once

#include <array>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "kernel/walls/wall.hpp"
#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace granular {

/// The space behind a triangle is solid (see MeshContacts). Coplanar triangles bear faces and sides as their plane, if they are
/// under all of the face or the side.
class MeshWall final : public Wall {
 public:
  /// Triangles with their vertices anticlockwise from outside, m, to single precision. Throws std::invalid_argument if there are
  /// none.
  explicit MeshWall(std::vector<supernormal::MeshTriangle> triangles);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  std::vector<supernormal::MeshTriangle> triangles_;  // with their places in this list as indices
  double rounding_ = 0;                               // m; how far a vertex may be from where it was drawn
  Eigen::KdBVH<double, 3, int> tree_;                 // indices of triangles_
  /// Coplanar triangles on which a face or a side may rest.
  struct Floor {
    Ground ground;
    double gap;  ///< m; of the particle and the plane
    double share;
    const supernormal::MeshTriangle* seed;  ///< in near_
  };
  /// Collects the triangles in a cube around the body, m, and in the box of the body, if any.
  void collect(const supernormal::Pose& pose, double half, const supernormal::BodyBox* body_box,
               std::vector<supernormal::MeshTriangle>& found) const;
  void find_floors(const ParticleShape& shape, const supernormal::Pose& pose);
  /// Whether a triangle is in the plane of another one, up to rounding.
  bool is_in_plane(const supernormal::MeshTriangle& triangle, const supernormal::MeshTriangle& seed) const;

  std::vector<supernormal::MeshTriangle> near_, around_;
  std::vector<double> tilts_;                                // of the triangles of contacts
  std::vector<std::array<Vector2, 3>> triangles_of_floors_;  // m
  std::vector<Patch> patches_;
  std::vector<Floor> floors_;
  supernormal::MeshContacts search_;
};

}  // namespace granular
