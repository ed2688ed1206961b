// The state of a world between two steps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bonds.hpp"
#include "model/geometry.hpp"
#include "wall_bodies.hpp"

namespace falling_particles {

/// A present grain, or the data of a removed one.
struct SavedGrain {
  std::uint64_t kind = 0;  ///< index into Scene::kinds
  double scale = 1;        ///< of the grain's lengths
  double mass = 0;         ///< kg
  bool is_present = true;
  bool is_awake = true;
  Point position = {};  ///< m
  std::array<double, 4> quaternion = {1, 0, 0, 0};
  Point velocity = {};          ///< m/s
  Point angular_velocity = {};  ///< rad/s

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(kind, scale, mass, is_present, is_awake, position, quaternion, velocity, angular_velocity);
  }
};

struct WorldState {
  std::uint64_t seed = 0;          ///< of ODE's random numbers
  std::vector<SavedGrain> grains;  ///< all grains so far
  bool has_lid = false;            ///< whether a hopper's outlet has its lid
  Point periods = {};              ///< m, of the cell along x, y and z; 0 along axes that are not periodic
  WallsState walls;
  BondsState bonds;
  std::vector<double> stepper;  ///< what it remembers (snStepperSave)

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(seed, grains, has_lid, periods, walls, bonds, stepper);
  }
};

}  // namespace falling_particles
