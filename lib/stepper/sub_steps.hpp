// How many sub-steps a step takes: as many as its loads need.
#pragma once

#include <array>
#include <tuple>

#include "stepper/contact.hpp"

namespace supernormal::stepper {

/// What a user asks for.
struct Accuracy {
  double sag = 2e-3;  ///< the largest overlap of a contact at rest, relative to the size of its body (the least radius of gyration)
  int least = 8;      ///< sub-steps of a step
  int most = 64;
};

/// A tall stack of soft contacts buckles as a column does, so the stiffness follows the load: no contact may give way to the force
/// of the last step by more than the accuracy. A contact's spring turns by a fixed phase in a sub-step, so a stiffer one takes
/// shorter sub-steps.
class SubSteps {
 public:
  Accuracy accuracy;

  /// The number of sub-steps for the next `time` (s) of a `step` (s).
  int choose(double time, double step);

  /// s; the sub-step that springs are made for, at least the present one. It follows a far shorter step slowly: a spring that
  /// stiffens at once throws what it carries.
  double spring() const { return spring_; }

  /// Takes the forces of the sub-steps that were made, which lasted `time` (s).
  void learn(const System& system, double time);

  /// s; what it knows, for a stepper that goes on from here.
  using State = std::array<double, 5>;
  State state() const { return {duration_, spring_, needed_, turning_, heaviest_}; }
  void set(const State& state) { std::tie(duration_, spring_, needed_, turning_, heaviest_) = std::tuple_cat(state); }

 private:
  double duration_ = 0;  // s, of a sub-step, if the step is long enough; 0 before the first step
  double spring_ = 0;    // s
  double needed_ = 0;    // s; the longest sub-step for the forces of the last step
  double turning_ = 0;   // s; the longest sub-step for the contacts that move
  double heaviest_ = 1;  // the mass of a body over the mass that a contact of it feels, the largest one
};

}  // namespace supernormal::stepper
