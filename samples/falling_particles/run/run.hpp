// The simulation of a scene from start to end.
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "model/scene.hpp"
#include "output/rendering.hpp"

namespace falling_particles {

struct RunOptions {
  std::filesystem::path out = "out";  ///< parent folder of the folder of the results
  int threads = 0;                    ///< that find contacts; 0: as many as the machine has
  bool quiet = false;                 ///< no progress on stderr
  int checkpoint_every = 0;           ///< steps between two checkpoints; 0: none, or as in the resumed run
  bool resume = false;                ///< resumes from the checkpoint of a killed run, if there is one
};

struct RunEnd {
  bool interrupted;
  bool leaked;                        ///< whether a grain was outside the container at any time
  std::filesystem::path folder;       ///< of the results
  std::vector<Rendering> renderings;  ///< pictures that other programs must still make in it
};

/// Simulates the scene and writes `out`/<scene>/. Prints the summary to stdout, and warnings and, unless quiet, progress to stderr.
/// An interrupt (interrupt.hpp) ends the run with the results so far. With checkpoints it ends at the next one, from which it can
/// be resumed.
RunEnd run(const Scene& scene, const RunOptions& options);

/// Shows the progress of a run on a stream: a line that is rewritten on a terminal, otherwise a line for every tenth.
class Progress {
 public:
  /// `done`: the steps of the run before it was resumed.
  Progress(std::FILE* stream, int steps, int done = 0);
  /// Ends the line, whatever stops the run.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Updates after step `step` of `steps`, with the simulated seconds and the contacts of the step.
  void update(int step, double simulated, std::size_t contacts);

 private:
  using Clock = std::chrono::steady_clock;

  std::FILE* stream_;
  bool terminal_;
  int steps_;
  int done_;
  Clock::time_point start_;
  Clock::time_point last_;  // when it was written
  int tenths_ = 0;
};

}  // namespace falling_particles
