#include "overlap.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "leaks.hpp"

namespace falling_particles {
namespace {

using Pairs = std::vector<std::pair<dGeomID, dGeomID>>;

void append(void* pairs, dGeomID g1, dGeomID g2) { static_cast<Pairs*>(pairs)->emplace_back(g1, g2); }

double smallest_half_axis(dGeomID geom) {
  const Grain* grain = grain_of(geom);
  return grain == nullptr ? INFINITY : grain->smallest_half_axis();
}

std::array<dReal, 4> middle_of(const snProximity& proximity) {
  std::array<dReal, 4> middle{};
  for (std::size_t i = 0; i < 3; ++i) middle[i] = (proximity.point1[i] + proximity.point2[i]) / 2;
  return middle;
}

}  // namespace

Overlap measure_overlap(const World& world) {
  Pairs pairs;
  world.name_pairs(&pairs, append);
  const PeriodicCell* cell = world.cell();
  Overlap overlap;
  for (const auto& [g1, g2] : pairs) {
    if (world.bonds() != nullptr && world.bonds()->hide(g1, g2)) continue;
    snProximity proximity;
    if (snGeomProximity(g1, g2, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
    if (!(proximity.gap < 0)) continue;
    if (cell != nullptr && !cell->contains(middle_of(proximity).data())) continue;  // another image of this overlap is in the cell
    const double depth = -proximity.gap;
    ++overlap.pairs;
    overlap.depth = std::max(overlap.depth, depth);
    const double relative = depth / std::min(smallest_half_axis(g1), smallest_half_axis(g2));
    if (relative <= overlap.relative_to_pair) continue;
    overlap.relative_to_pair = relative;
    overlap.worst = {g1, g2};
    overlap.worst_depth = depth;
  }
  return overlap;
}

std::size_t count_outside(const World& world) {
  const Inside inside(world);
  std::size_t count = 0;
  for (const Grain& grain : world.present()) {
    if (!inside.contains(grain.position(), grain.bounding_radius())) ++count;
  }
  return count;
}

}  // namespace falling_particles
