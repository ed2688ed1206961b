// Superlevel sets and contour lines of a function given on a grid.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

namespace explain_pair {

using Vector2 = Eigen::Vector2d;
using Polyline = std::vector<Vector2>;

/// Values at columns x rows nodes. The node (column, row) has these coordinates.
class Grid {
 public:
  Grid(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows), values_(columns * rows) {}

  /// Sets each value to the function value at (column, row).
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

/// The set where the function is at least `level`: closed polygons, holes included, by marching squares with linear interpolation.
/// Two diagonal corners of a cell above the level are connected if the mean of all four corners is above, too.
std::vector<Polyline> superlevel_polygons(const Grid& grid, double level);

/// The contour lines: the parts of such polygons off the border of the grid. A closed line ends at its start.
std::vector<Polyline> without_border(const std::vector<Polyline>& polygons, const Grid& grid);

/// Removes points that are nearer than `error` to the line between the remaining ones (Douglas and Peucker 1973).
Polyline simplified(const Polyline& line, double error);

/// The smallest round step (1, 2 or 5 times a power of ten) that divides `range` into at most `parts` parts.
double round_step(double range, int parts);

}  // namespace explain_pair
