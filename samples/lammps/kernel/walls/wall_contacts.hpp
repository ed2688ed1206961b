// The contacts of one particle with a wall, and their histories.
#pragma once

#include <array>
#include <vector>

#include "kernel/contact_law.hpp"
#include "kernel/walls/wall.hpp"

namespace granular {

/// The histories of a particle at a wall, one for each contact.
struct WallHistory {
  static constexpr int kMost = 6;  ///< any further contacts start every step without springs
  std::array<ContactHistory, kMost> contacts{};
  int count = 0;  ///< the first `count` are valid
};

/// The action of a wall on a particle.
struct WallForce {
  Vector3 force = Vector3::Zero();        ///< N; on the particle
  Vector3 torque = Vector3::Zero();       ///< N m; on the particle, about its centre
  Vector3 wall_torque = Vector3::Zero();  ///< N m; on the wall, about the origin of its frame
  double energy = 0;                      ///< J; in the springs
  double depth = 0;                       ///< m; the largest
  int contacts = 0;
};

/// The forces of a wall. `wall_body` has the pose and velocity of the wall, and no mobility. A contact continues with the springs
/// of the last step's contact with the nearest normal, if that is within 22.5 degrees. `contacts` is scratch memory. With a step of
/// 0 the history is only read.
WallForce find_wall_force(Wall& wall, const Body& wall_body, const ParticleShape& shape, const Body& particle,
                          const ContactMaterial& material, double step, WallHistory& history, std::vector<WallContact>& contacts);

}  // namespace granular
