// The lattice on which grains start.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>

#include "scene/scene.hpp"

namespace falling_particles {

/// There is no cell left for a grain.
class NoRoom : public std::runtime_error {
 public:
  NoRoom() : std::runtime_error("the container has no room for all grains at the start") {}
};

/// The cells in which the grains of a scene start, layer upon layer from the container's lowest possible start: each holds the
/// largest grain in any attitude, is free of walls, and a layer's cells share out the plan of the container.
class Lattice {
 public:
  /// The container's plan is at least one cell wide.
  explicit Lattice(const Scene& scene);

  /// Indices of the next cell along x, y, z. Throws NoRoom when all cells below the container's ceiling are taken.
  std::array<std::size_t, 3> next();

  const Point& corner() const { return corner_; }  ///< m, lower corner of cell 0, 0, 0
  const Point& cell() const { return cell_; }      ///< m, size of a cell
  std::size_t layers() const { return layers_; }   ///< number of layers that next() has used

  double top() const { return corner_[2] + static_cast<double>(layers_) * cell_[2]; }  ///< m, upper end of those layers

 private:
  const Container& container_;
  Point corner_;
  Point cell_;
  std::array<std::size_t, 2> cells_;  // number of cells in a layer
  std::size_t visited_ = 0;
  std::size_t layers_ = 0;
};

}  // namespace falling_particles
