#include "lattice.hpp"

#include <algorithm>
#include <cmath>

#include "container.hpp"

namespace falling_particles {
namespace {

constexpr std::size_t kFewestHalvings = 2;  // with fewer halvings, grains use the largest cells

}  // namespace

Lattice::Lattice(const Scene& scene)
    : container_(scene.container), largest_radius_(scene.largest_bounding_radius()), corner_(), cell_(), cells_() {
  const Rectangle plan = plan_of(container_);
  const double smallest = scene.smallest_cell();
  for (std::size_t axis : {0U, 1U}) {
    cells_[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(plan.width[axis] / smallest));
    cell_[axis] = plan.width[axis] / static_cast<double>(cells_[axis]);
    corner_[axis] = plan.corner[axis];
  }
  cell_[2] = smallest;
  corner_[2] = lowest_start(container_) + scene.drop.height;
}

std::size_t Lattice::halvings_for(double radius) const {
  const auto halvings = static_cast<std::size_t>(std::max(0.0, std::floor(std::log2(largest_radius_ / radius))));
  return halvings < kFewestHalvings ? 0 : halvings;
}

Lattice::Cell Lattice::next(double radius) { return take(halvings_for(radius)); }

Lattice::Cell Lattice::take(std::size_t halvings) {
  if (halvings == 0) return take_largest();
  if (free_.size() <= halvings) free_.resize(halvings + 1);
  if (free_[halvings].empty()) {
    const Cell whole = take(halvings - 1);
    const Point half = {whole.size[0] / 2, whole.size[1] / 2, whole.size[2] / 2};
    for (unsigned corner = 8; corner-- > 0;) {  // the lower four are used first
      Cell part{whole.offset, half};
      for (unsigned axis = 0; axis < 3; ++axis) part.offset[axis] += ((corner >> axis) & 1U) != 0 ? half[axis] : 0;
      free_[halvings].push_back(part);
    }
  }
  const Cell cell = free_[halvings].back();
  free_[halvings].pop_back();
  return cell;
}

Lattice::Cell Lattice::take_largest() {
  while (true) {
    const std::size_t i = visited_++;
    const std::array<std::size_t, 3> index{i % cells_[0], i / cells_[0] % cells_[1], i / (cells_[0] * cells_[1])};
    Cell cell{{}, cell_};
    Point lower = corner_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell.offset[axis] = static_cast<double>(index[axis]) * cell_[axis];
      lower[axis] += cell.offset[axis];
    }
    if (lower[2] + cell_[2] > ceiling_of(container_)) throw NoRoom();
    if (!has_room(container_, lower, cell_)) continue;
    layers_ = index[2] + 1;
    return cell;
  }
}

Lattice filled_lattice(const Scene& scene) {
  Lattice lattice(scene);
  for (const GrainCount& entry : scene.kinds) {
    const double radius = entry.kind.bounding_radius();
    for (std::size_t i = 0; i < static_cast<std::size_t>(entry.count); ++i) lattice.next(entry.scale(i) * radius);
  }
  return lattice;
}

}  // namespace falling_particles
