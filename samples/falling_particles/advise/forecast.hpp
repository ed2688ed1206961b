// A forecast of the cost of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

/// The cost of a run.
struct Forecast {
  int most_grains = 0;  ///< at once, without the effect of sinks
  int steps = 0;
  int frames = 0;
  std::vector<std::uint64_t> samples;  ///< of each measurement
  std::vector<std::uint64_t> bonds;    ///< of each section [[bond]] at the start
  double memory = 0;                   ///< bytes, in a bed of all grains
  double table_bytes = 0;              ///< bytes, measurements included
  double picture_bytes = 0;
  int timed_steps = 0;
  double step = 0;  ///< s of processor time, the mean of the first `timed_steps`

  double seconds() const { return steps * step; }  ///< s, if all steps took as long as the timed ones
};

/// Takes the first steps of the scene on one thread, which takes up to a second. Throws std::runtime_error.
Forecast forecast(const Scene& scene);

/// The scene and the forecast as lines of text.
std::string describe(const Scene& scene, const Forecast& forecast);

}  // namespace falling_particles
