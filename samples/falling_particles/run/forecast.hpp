// A forecast of the cost of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

/// Contacts per grain in a bed, each counted once: 2.3 to 3 in the beds of samples/scenes.
inline constexpr double kContactsPerGrain = 3;

/// Seconds of processor time per grain and step in a bed.
struct BedTimes {
  double solver = 0;        ///< quickstep, for kContactsPerGrain contacts with the effects of the scene
  double narrow_phase = 0;  ///< for the pairs whose boxes meet, with warm starts
  double all = 0;           ///< of a whole step
};

/// Times a synthetic bed of `grains` of the scene. For the solver, each grain of a row is joined to the next three. For the narrow
/// phase, pairs of grains touch. Throws std::runtime_error.
BedTimes time_bed(const Scene& scene, int grains);

/// The cost of a run if the most grains that the scene may have at once lay in a bed from the start.
struct Forecast {
  int most_grains = 0;  ///< at once, without the effect of sinks
  int steps = 0;
  int frames = 0;
  std::vector<std::uint64_t> samples;  ///< of each measurement
  std::vector<std::uint64_t> bonds;    ///< of each section [[bond]] at the start
  double memory = 0;                   ///< bytes
  double table_bytes = 0;              ///< bytes, measurements included
  double picture_bytes = 0;
  double start_step = 0;  ///< s, measured time of a step at the start
  BedTimes bed;

  double bed_step() const { return bed.all * most_grains; }  ///< s
  double seconds() const { return steps * bed_step(); }      ///< s, of processor time
};

/// Times some steps of the scene and a bed of its grains on one thread, which takes a second or two. Throws std::runtime_error.
Forecast forecast(const Scene& scene);

/// The scene and the forecast as lines of text.
std::string describe(const Scene& scene, const Forecast& forecast);

}  // namespace falling_particles
