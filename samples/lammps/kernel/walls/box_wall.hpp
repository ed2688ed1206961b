// A box with particles inside.
#pragma once

#include <memory>
#include <vector>

#include "kernel/walls/plane_wall.hpp"

namespace granular {

/// Six flat walls that look inwards.
class BoxWall final : public Wall {
 public:
  /// The lowest and the highest corner, m; std::invalid_argument when they are not.
  BoxWall(const Vector3& low, const Vector3& high);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  std::vector<std::unique_ptr<PlaneWall>> sides_;
};

}  // namespace granular
