#include "lattice.hpp"

#include <algorithm>

#include "container/container.hpp"

namespace falling_particles {

Lattice::Lattice(const Scene& scene) : container_(scene.container), corner_(), cell_(), cells_() {
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

std::array<std::size_t, 3> Lattice::next() {
  while (true) {
    const std::size_t i = visited_++;
    const std::array<std::size_t, 3> index{i % cells_[0], i / cells_[0] % cells_[1], i / (cells_[0] * cells_[1])};
    Point lower = corner_;
    for (std::size_t axis = 0; axis < 3; ++axis) lower[axis] += static_cast<double>(index[axis]) * cell_[axis];
    if (lower[2] + cell_[2] > ceiling_of(container_)) throw NoRoom();
    if (!has_room(container_, lower, cell_)) continue;
    layers_ = index[2] + 1;
    return index;
  }
}

}  // namespace falling_particles
