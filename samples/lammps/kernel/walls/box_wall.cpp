#include "kernel/walls/box_wall.hpp"

#include <stdexcept>

namespace granular {

BoxWall::BoxWall(const Vector3& low, const Vector3& high) {
  if (!(low.array() < high.array()).all()) throw std::invalid_argument("box: the low corner is not below the high one");
  for (int axis = 0; axis < 3; ++axis) {
    sides_.push_back(std::make_unique<PlaneWall>(low, Vector3::Unit(axis)));
    sides_.push_back(std::make_unique<PlaneWall>(high, -Vector3::Unit(axis)));
  }
}

void BoxWall::add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) {
  for (const auto& side : sides_) side->add_contacts(shape, pose, contacts);
}

}  // namespace granular
