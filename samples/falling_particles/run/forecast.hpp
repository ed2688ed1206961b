// What a run of a scene would take.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "made_up_bed.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// What a run would take if all grains that the scene may have at once lay in a bed from the start.
struct Forecast {
  int most_grains = 0;  ///< at once, as if sinks took none
  int steps = 0;
  int frames = 0;
  std::vector<std::uint64_t> samples;  ///< of each measurement
  double memory = 0;                   ///< bytes
  double table_bytes = 0;              ///< measurements included
  double picture_bytes = 0;
  double start_step = 0;  ///< s, of a step as the scene starts, measured
  BedTimes bed;

  double bed_step() const { return bed.all * most_grains; }  ///< s
  double seconds() const { return steps * bed_step(); }      ///< of processor time
};

/// Takes some steps of the scene and times a bed of its grains, on one thread; for a second or two. Throws std::runtime_error.
Forecast forecast(const Scene& scene);

/// Scene and forecast in words, a line each.
std::string describe(const Scene& scene, const Forecast& forecast);

}  // namespace falling_particles
