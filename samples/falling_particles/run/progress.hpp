// A progress bar.
#pragma once

#include <chrono>
#include <cstdio>

namespace falling_particles {

/// Shows the progress of a run on a stream: a bar that is redrawn on a terminal, otherwise a line for every tenth.
class Progress {
 public:
  /// `done`: the steps of the run before it was resumed.
  Progress(std::FILE* stream, int steps, int done = 0);
  /// Ends the bar's line, whatever stops the run.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Updates after step `step` of `steps`, with the simulated seconds and the contacts of the step.
  void update(int step, double simulated, std::size_t contacts);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(int step, double simulated, std::size_t contacts);
  double seconds_left(int step) const;

  std::FILE* stream_;
  bool terminal_;
  int steps_;
  int done_;
  Clock::time_point start_;
  Clock::time_point last_draw_;
  int tenths_ = 0;
};

}  // namespace falling_particles
