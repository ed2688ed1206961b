// A flat wall.
#pragma once

#include "kernel/walls/wall.hpp"

namespace granular {

/// The half-space behind a plane.
class PlaneWall final : public Wall {
 public:
  /// A point of the plane, m, and its normal out of the wall, any length but 0. Throws std::invalid_argument otherwise.
  PlaneWall(const Vector3& point, const Vector3& normal);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  Vector3 normal_;
  double offset_;  // m; normal . x on the plane
};

}  // namespace granular
