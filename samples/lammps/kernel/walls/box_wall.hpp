// A box around the particles.
#pragma once

#include <memory>
#include <vector>

#include "kernel/walls/plane_wall.hpp"

namespace granular {

/// Six flat walls that face inwards.
class BoxWall final : public Wall {
 public:
  /// The lowest and the highest corner, m. Throws std::invalid_argument unless low < high.
  BoxWall(const Vector3& low, const Vector3& high);

  void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) override;

 private:
  std::vector<std::unique_ptr<PlaneWall>> sides_;
};

}  // namespace granular
