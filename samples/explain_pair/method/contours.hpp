// Regions and lines of a function that is known at the nodes of a grid.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace explain_pair {

using Vector2 = Eigen::Vector2d;
using Polyline = std::vector<Vector2>;

/// Values at columns x rows nodes; the node (column, row) is at these coordinates.
class Grid {
 public:
  Grid(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows), values_(columns * rows) {}

  /// Sets every value to that of the function at (column, row).
  void fill(const std::function<double(double column, double row)>& value);

  double at(std::size_t column, std::size_t row) const { return values_[row * columns_ + column]; }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double least() const;
  double most() const;

 private:
  std::size_t columns_, rows_;
  std::vector<double> values_;
};

/// Where the function is at least `level`: closed polygons, holes included, by marching squares with linear interpolation. Two
/// corners of a cell that are above and diagonal to each other are connected if the mean of the four is above.
std::vector<Polyline> superlevel_polygons(const Grid& grid, double level);

/// The parts of such polygons that are not on the border of the grid: the contour lines. A closed one ends at its start.
std::vector<Polyline> without_border(const std::vector<Polyline>& polygons, const Grid& grid);

/// The polyline without points that are nearer than `error` to the line between those that remain (Douglas and Peucker 1973).
Polyline simplified(const Polyline& line, double error);

/// The least round step (1, 2 or 5 times a power of ten) that divides `range` into at most so many parts.
double round_step(double range, int parts);

}  // namespace explain_pair
