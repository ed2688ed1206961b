#include "placement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace falling_particles {
namespace {

std::vector<std::size_t> shuffled_kinds(const Scene& scene, Random& random) {
  std::vector<std::size_t> kinds;
  for (std::size_t kind = 0; kind < scene.grains.size(); ++kind) {
    kinds.insert(kinds.end(), static_cast<std::size_t>(scene.grains[kind].count), kind);
  }
  for (std::size_t i = kinds.size(); i > 1; --i) std::swap(kinds[i - 1], kinds[random.below(i)]);  // Fisher-Yates
  return kinds;
}

}  // namespace

std::vector<Placement> place(const Scene& scene, Random& random) {
  const double radius = scene.largest_bounding_radius();
  const double smallest_cell = 2 * radius * (1 + scene.drop.gap);
  std::array<std::size_t, 2> cells{};
  std::array<double, 3> cell{0, 0, smallest_cell};
  for (std::size_t axis : {0U, 1U}) {
    cells[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(scene.box.width[axis] / smallest_cell));
    cell[axis] = scene.box.width[axis] / static_cast<double>(cells[axis]);
  }
  std::vector<Placement> placements;
  for (const std::size_t kind : shuffled_kinds(scene, random)) {
    const std::size_t i = placements.size();
    const std::array<std::size_t, 3> index{i % cells[0], i / cells[0] % cells[1], i / (cells[0] * cells[1])};
    // A grain may stand anywhere in its cell, its own bounding sphere inside.
    const double own_radius = scene.grains[kind].grain.bounding_radius();
    Placement placement{kind, {0, 0, scene.drop.height}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double room = std::max(0.0, cell[axis] - 2 * own_radius);
      placement.position[axis] += static_cast<double>(index[axis]) * cell[axis] + own_radius + room * random.uniform();
    }
    placement.quaternion = random.rotation();
    placements.push_back(placement);
  }
  return placements;
}

}  // namespace falling_particles
