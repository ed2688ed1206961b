// Plots of a run's tables.
#pragma once

#include "picture.hpp"

namespace falling_particles {

/// Makes a plot beside every table of numbers over time, energies.svg beside energies.csv. gnuplot draws it by the scripts of
/// plots/, which the program contains.
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
