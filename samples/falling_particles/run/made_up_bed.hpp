// A bed that is made up to be timed.
#pragma once

#include <vector>

#include "model/scene.hpp"
#include "world/placement.hpp"

namespace falling_particles {

/// Contacts of a grain in a bed, each counted once: 2.3 to 3 in the beds of samples/scenes.
inline constexpr double kContactsPerGrain = 3;

/// Seconds of processor time for a grain of a bed in a step.
struct BedTimes {
  double solver = 0;        ///< quickstep, for kContactsPerGrain contacts as the effects of the scene set them up
  double narrow_phase = 0;  ///< for the pairs whose boxes meet, remembered normals and all
  double all = 0;           ///< of a step
};

/// Times a bed of `grains` of the scene: they hang in a row, joined each to the next three, and in pairs that touch. Throws
/// std::runtime_error.
BedTimes time_bed(const Scene& scene, int grains);

}  // namespace falling_particles
