// Lacey's index of mixing.
#pragma once

#include <cstddef>
#include <vector>

#include "table_text.hpp"

namespace falling_particles {

/// The grains of two groups in the cells of a grid, for M = (s0^2 - s^2) / (s0^2 - sr^2), by number. s^2 is the variance of the
/// first group's fraction over the cells with grains, weighted by their grains; s0^2 = p (1 - p) is the variance of groups apart;
/// sr^2 = p (1 - p) (K - 1) / (N - 1) is the mean of s^2 for N grains in random order in K cells. P. M. C. Lacey, Developments in
/// the theory of particle mixing, J. Appl. Chem. 4 (1954) 257-268.
class LaceyGrid {
 public:
  explicit LaceyGrid(std::size_t cells) : cells_(cells) {}

  /// `cell`: below the number of cells.
  void add(std::size_t cell, bool is_first);

  /// The columns of write().
  static constexpr const char* kColumns = "grains,occupied_cells,fraction,variance,variance_segregated,variance_random,lacey";
  /// All but the first two are empty if there is only one group, or no cell with two grains.
  void write(TableText& table) const;

 private:
  struct Count {
    double first = 0;
    double both = 0;
  };
  std::vector<Count> cells_;
  Count all_;
};

}  // namespace falling_particles
