// A synthetic benchmark of a bed.
#pragma once

#include <vector>

#include "model/scene.hpp"
#include "world/placement.hpp"

namespace falling_particles {

/// Contacts per grain in a bed, each counted once: 2.3 to 3 in the beds of samples/scenes.
inline constexpr double kContactsPerGrain = 3;

/// Seconds of processor time per grain and step in a bed.
struct BedTimes {
  double solver = 0;        ///< quickstep, for kContactsPerGrain contacts with the effects of the scene
  double narrow_phase = 0;  ///< for the pairs whose boxes meet, with warm starts
  double all = 0;           ///< of a whole step
};

/// Times a bed of `grains` of the scene. For the solver, each grain of a row is joined to the next three. For the narrow phase,
/// pairs of grains touch. Throws std::runtime_error.
BedTimes time_bed(const Scene& scene, int grains);

}  // namespace falling_particles
