#include "kernel/walls/mesh_wall.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

#include "supernormal/contact/body_box.hpp"

namespace granular {
namespace {

using Box = Eigen::AlignedBox3d;

Box box_of(const supernormal::MeshTriangle& triangle) {
  Box box;
  for (const Vector3& vertex : triangle.vertices) box.extend(vertex);
  return box;
}

/// Collects the triangles that touch the box of a body.
struct Collector {
  const std::vector<supernormal::MeshTriangle>& triangles;
  const supernormal::BodyBox body_box;
  const supernormal::Pose& pose;
  const Box box;
  std::vector<supernormal::MeshTriangle>& found;

  // Eigen's tree requires these names.
  bool intersectVolume(const Box& volume) const { return volume.intersects(box); }  // NOLINT(readability-identifier-naming)
  bool intersectObject(int index) {                                                 // NOLINT(readability-identifier-naming)
    const supernormal::MeshTriangle& triangle = triangles[static_cast<std::size_t>(index)];
    if (body_box.touches(pose, triangle.vertices)) found.push_back(triangle);
    return false;  // continue the search
  }
};

}  // namespace

MeshWall::MeshWall(std::vector<supernormal::MeshTriangle> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) throw std::invalid_argument("mesh: there are no triangles");
  std::vector<int> indices(triangles_.size());
  std::iota(indices.begin(), indices.end(), 0);
  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const auto& triangle : triangles_) boxes.push_back(box_of(triangle));
  tree_.init(indices.begin(), indices.end(), boxes.begin(), boxes.end());
}

void MeshWall::add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) {
  near_.clear();
  const Vector3 reach = Vector3::Constant(shape.bounding_radius);
  Collector collector{triangles_, supernormal::BodyBox::of(shape.body), pose, Box(pose.position - reach, pose.position + reach),
                      near_};
  Eigen::BVIntersect(tree_, collector);
  if (near_.empty()) return;
  for (const supernormal::MeshContact& contact : search_.find(shape.body, pose, near_)) {
    const supernormal::Proximity& found = contact.proximity;
    if (found.gap < 0) contacts.push_back({found.normal, found.contact, -found.gap});
  }
}

}  // namespace granular
