// A surface that particles touch and that does not give way.
#pragma once

#include <vector>

#include "kernel/particle_shape.hpp"
#include "supernormal/proximity/pose.hpp"

namespace granular {

using supernormal::Matrix3;

/// Where a particle overlaps a wall, in the wall's frame.
struct WallContact {
  Vector3 normal;                       ///< unit, from the particle to the wall
  Vector3 point;                        ///< m; where the force acts
  double depth = 0;                     ///< m; > 0
  Matrix3 curvature = Matrix3::Zero();  ///< 1/m; of the wall: negative where it is hollow
};

/// A wall at rest in its own frame.
class Wall {
 public:
  Wall() = default;
  Wall(const Wall&) = delete;
  Wall& operator=(const Wall&) = delete;
  virtual ~Wall() = default;

  /// Adds the contacts of a particle, whose pose is in the wall's frame.
  virtual void add_contacts(const ParticleShape& shape, const supernormal::Pose& pose, std::vector<WallContact>& contacts) = 0;
};

}  // namespace granular
