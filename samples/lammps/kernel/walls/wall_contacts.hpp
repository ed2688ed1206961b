// The contacts of one particle with a wall, and what they remember.
#pragma once

#include <array>
#include <vector>

#include "kernel/contact_law.hpp"
#include "kernel/walls/wall.hpp"

namespace granular {

/// What a particle remembers of a wall: one history for each contact.
struct WallHistory {
  static constexpr int kMost = 6;  ///< more contacts than these start without springs at every step
  std::array<ContactHistory, kMost> contacts{};
  int count = 0;  ///< the first ones are valid
};

/// What a wall does to a particle.
struct WallForce {
  Vector3 force = Vector3::Zero();        ///< N; on the particle
  Vector3 torque = Vector3::Zero();       ///< N m; on the particle, about its centre
  Vector3 wall_torque = Vector3::Zero();  ///< N m; on the wall, about the origin of its frame
  double energy = 0;                      ///< J; in the springs
  int contacts = 0;
};

/// The forces of a wall. `wall_body` is the wall as a body without mobility: its pose and velocity. A contact takes over the
/// springs of that of the last step whose normal is nearest, within a quarter of a right angle. `contacts` is scratch memory. With
/// a step of 0 the history is only read.
WallForce find_wall_force(Wall& wall, const Body& wall_body, const ParticleShape& shape, const Body& particle,
                          const ContactMaterial& material, double step, WallHistory& history, std::vector<WallContact>& contacts);

}  // namespace granular
