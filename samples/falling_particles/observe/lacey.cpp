#include "lacey.hpp"

namespace falling_particles {

void LaceyGrid::add(std::size_t cell, bool is_first) {
  for (Count* count : {&cells_[cell], &all_}) {
    count->both += 1;
    if (is_first) count->first += 1;
  }
}

void LaceyGrid::write(TableText& table) const {
  const double fraction = all_.both > 0 ? all_.first / all_.both : 0;
  double occupied = 0;
  double variance = 0;
  for (const Count& cell : cells_) {
    if (cell.both == 0) continue;
    ++occupied;
    const double excess = cell.first / cell.both - fraction;
    variance += cell.both * excess * excess / all_.both;
  }
  const double segregated = fraction * (1 - fraction);
  table.add(static_cast<std::size_t>(all_.both)).add(static_cast<std::size_t>(occupied));
  if (segregated == 0 || occupied >= all_.both) {  // only one group, or as many cells as grains, for which the index is undefined
    constexpr int kOtherColumns = 5;
    table.blank(kOtherColumns);
    return;
  }
  const double random = segregated * (occupied - 1) / (all_.both - 1);
  table.add(fraction).add(variance).add(segregated).add(random).add((segregated - variance) / (segregated - random));
}

}  // namespace falling_particles
