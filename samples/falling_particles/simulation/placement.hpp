#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "random.hpp"
#include "scene/scene.hpp"

namespace falling_particles {

struct Placement {
  std::size_t kind;                  ///< index into Scene::grains
  Point position;                    ///< m
  std::array<double, 4> quaternion;  ///< w, x, y, z
};

/// Where every grain starts: kinds shuffled, layer upon layer on a jittered lattice, random attitudes. No two touch, nor any a
/// wall: each stays within its own cell. In a periodic container anywhere, overlaps and all.
std::vector<Placement> place(const Scene& scene, Random& random);

}  // namespace falling_particles
