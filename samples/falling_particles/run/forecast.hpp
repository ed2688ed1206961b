// A forecast of the cost of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scene.hpp"
#include "synthetic_bed.hpp"

namespace falling_particles {

/// The cost of a run if the most grains that the scene may have at once lay in a bed from the start.
struct Forecast {
  int most_grains = 0;  ///< at once, without the effect of sinks
  int steps = 0;
  int frames = 0;
  std::vector<std::uint64_t> samples;  ///< of each measurement
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
