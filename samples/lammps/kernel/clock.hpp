// The physical time of a run.
#pragma once

namespace granular {

/// The time (s) of a run with steps of any length. The step counter of LAMMPS is no measure of time: it may be reset, and the step
/// may change at any moment. While the step is constant, the time is an exact product.
class Clock {
 public:
  struct State {
    double before = 0;  ///< s; time before the first step of the present length
    double steps = 0;   ///< steps of the present length so far; an integer
    double step = 0;    ///< s
  };

  Clock() = default;
  explicit Clock(const State& state) : state_(state) {}

  double now() const { return state_.before + state_.steps * state_.step; }
  const State& state() const { return state_; }

  /// Adds one step (s).
  void advance(double step) {
    if (step != state_.step) state_ = {now(), 0, step};
    ++state_.steps;
  }

 private:
  State state_;
};

}  // namespace granular
