// Plots of a run's tables.
#pragma once

#include "picture.hpp"

namespace falling_particles {

/// A plot beside every table of numbers over time, energies.svg beside energies.csv, by gnuplot and the scripts of plots/, which
/// the program holds.
class Plots final : public Picture {
 public:
  explicit Plots(const Contents& contents) : contents_(contents) {}
  void add(const Frame& /*frame*/) override {}
  void finish(const std::string& /*summary*/) override {}
  std::vector<Rendering> renderings() const override;

 private:
  const Contents& contents_;
};

}  // namespace falling_particles
