// The lattice on which grains start.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "scene.hpp"

namespace falling_particles {

/// Thrown when no cell is left for a grain.
class NoRoom : public std::runtime_error {
 public:
  NoRoom() : std::runtime_error("the container has no room for all grains at the start") {}
};

/// The cells in which the grains of a scene start. The first layer is at the lowest possible start in the container. The largest
/// cells tile the plan of the container and are free of walls. They hold the largest grain in any orientation. A grain that is at
/// most a quarter as large gets a smaller cell. Cells are halved along all axes until half a cell would be too small. So the height
/// of the start follows from the volume of the grains. Grains of similar size share the cells of one size and are mixed one by one.
class Lattice {
 public:
  /// The container's plan must be at least one cell wide.
  explicit Lattice(const Scene& scene);

  struct Cell {
    Point offset;  ///< m, of its lower corner, relative to corner()
    Point size;    ///< m
  };
  /// The next free cell for a grain with this bounding radius (m). Throws NoRoom when all cells below the container's ceiling are
  /// used.
  Cell next(double radius);

  const Point& corner() const { return corner_; }  ///< m, lower corner of the lattice
  /// m, upper end of the layers of largest cells that next() has used
  double top() const { return corner_[2] + static_cast<double>(layers_) * cell_[2]; }

 private:
  std::size_t halvings_for(double radius) const;
  Cell take(std::size_t halvings);
  Cell take_largest();

  const Container& container_;
  double largest_radius_;  // m
  Point corner_;
  Point cell_;                        // m, size of the largest cells
  std::array<std::size_t, 2> cells_;  // number of the largest cells in a layer
  std::size_t visited_ = 0;
  std::size_t layers_ = 0;
  std::vector<std::vector<Cell>> free_;  // by number of halvings; the next cell is last
};

/// The lattice after each grain of the scene has received its cell. Throws NoRoom.
Lattice filled_lattice(const Scene& scene);

}  // namespace falling_particles
