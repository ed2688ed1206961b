// The state of grains from which a scene starts.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "geometry.hpp"

namespace falling_particles {

/// A grain of a state.
struct StartGrain {
  std::size_t kind = 0;                             ///< index into Scene::kinds
  double scale = 1;                                 ///< factor on the lengths of the kind
  Point position = {};                              ///< m
  std::array<double, 4> quaternion = {1, 0, 0, 0};  ///< w, x, y, z
  Point velocity = {};                              ///< m/s
  Point angular_velocity = {};                      ///< rad/s
  unsigned line = 0;                                ///< of the file
  std::size_t number = 0;                           ///< in the file: its column body, or its place from 0
};

/// The section [start] of a scene file, checked but for overlaps (run/start_check.cpp).
struct StartState {
  std::filesystem::path file = {};
  std::optional<double> time = {};  ///< s, of the run that wrote the file
  bool has_velocities = false;      ///< whether the file has any; without them all grains start at rest
  double overlap = 0;               ///< the deepest allowed overlap, relative to the smallest half-axis of the smaller grain
  std::vector<StartGrain> grains = {};

  double largest_speed() const;  ///< m/s
};

}  // namespace falling_particles
