// The solver's answers to fixed sets of pairs: the figures that an ablation compares.
#pragma once

#include <vector>

#include "sample.hpp"

namespace supernormal::ablation {

/// Counts over one set of pairs.
struct Counts {
  long queries = 0;
  long evaluations = 0;  ///< of the gap function
  long unconverged = 0;  ///< answers reported as such, at the default tolerance or a looser one
  long missed = 0;       ///< converged, but more than 1e-6 of the smallest half-extent below the proved maximum
  long violations = 0;   ///< of the contract of an answer (tests/soak)

  double evaluations_per_query() const { return static_cast<double>(evaluations) / static_cast<double>(queries); }
  Counts& operator+=(const Counts& other);
};

/// One row: every set.
struct Figures {
  Counts reference;   ///< the 1600 pairs of tests/data; `missed`: wrong by more than 1e-6
  Counts catalogue;   ///< the hard cases
  Counts smooth;      ///< random superellipsoids of every class, overlapped by up to 30 %
  Counts kinked;      ///< the same against boxes, cylinders, capsules and polytopes
  Counts no_hessian;  ///< superellipsoids again, with only support function and boundary point
  Counts soak;        ///< the soak's mix
  Counts sharp;       ///< the soak's sharp mix
};

/// The sets, drawn once, with the proved maxima of the random pairs.
class Measurement {
 public:
  /// `pairs`: the size of each random set. `samples`: the size of each mix of the soak.
  Measurement(int pairs, int samples);

  Figures measure() const;

 private:
  struct Pair {
    samples::HardCase pair;
    double unit = 1;     // m
    double maximum = 0;  // m; of the gap function, proved
    bool is_known = false;
  };
  std::vector<Pair> draw(int kind, int count) const;
  Counts measure(const std::vector<Pair>& pairs) const;
  Counts measure_soak(const soak::SampleSource& source) const;

  int samples_;
  std::vector<Pair> reference_, catalogue_, smooth_, kinked_, no_hessian_;
  soak::SampleSource mix_, sharp_;
};

}  // namespace supernormal::ablation
