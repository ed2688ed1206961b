// Start poses and velocities of the grains.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/random.hpp"
#include "model/scene.hpp"

namespace falling_particles {

struct Placement {
  std::size_t kind;                  ///< index into Scene::kinds
  Point position;                    ///< m
  std::array<double, 4> quaternion;  ///< w, x, y, z
  double scale = 1;                  ///< factor on the grain's lengths
  Point velocity = {};               ///< m/s
  Point angular_velocity = {};       ///< rad/s
};

/// Places every grain with a random orientation, layer upon layer on a jittered lattice, with the kinds shuffled. Each grain stays
/// within its own cell, so no grain touches another one or a wall. In a periodic container grains are placed anywhere and may
/// overlap. In a scene with a state, the grains are where the state has them, in its order.
std::vector<Placement> place(const Scene& scene, Random& random);

}  // namespace falling_particles
