#include "kernel/walls/plane_wall.hpp"

#include <stdexcept>

#include "supernormal/proximity/plane.hpp"

namespace granular {

PlaneWall::PlaneWall(const Vector3& point, const Vector3& normal) : normal_(normal.normalized()), offset_(normal_.dot(point)) {
  if (!(normal.norm() > 0)) throw std::invalid_argument("plane: the normal has no direction");
}

void PlaneWall::add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) {
  if (normal_.dot(pose.position) - offset_ >= shape.bounding_radius) return;
  const supernormal::Proximity found = supernormal::find_plane_proximity(shape.body, pose, normal_, offset_);
  if (found.gap < shape.bulge)
    contacts.push_back({found.normal, found.contact, -found.gap, Matrix3::Zero(), Ground::plane(found.point2, normal_)});
}

}  // namespace granular
