// The time of a run.
#pragma once

namespace granular {

/// The time (s) that has passed in the steps of a run, which need not be alike. LAMMPS' counter of steps tells no time: it may be
/// set anew, and the step may change at any moment. While the step is the same, the time is an exact product.
class Clock {
 public:
  struct State {
    double before = 0;  ///< s, passed before the step had its present length
    double steps = 0;   ///< steps of this length so far; a whole number
    double step = 0;    ///< s
  };

  Clock() = default;
  explicit Clock(const State& state) : state_(state) {}

  double now() const { return state_.before + state_.steps * state_.step; }
  const State& state() const { return state_; }

  /// A step (s) has been made.
  void advance(double step) {
    if (step != state_.step) state_ = {now(), 0, step};
    ++state_.steps;
  }

 private:
  State state_;
};

}  // namespace granular
