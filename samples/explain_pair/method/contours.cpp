#include "method/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace explain_pair {
namespace {

constexpr double kBelow = -std::numeric_limits<double>::infinity();

/// Marching squares over the grid. It is framed by nodes below every level, so that all polygons close. A frame node has the
/// coordinates of the nearest grid node.
class Marching {
 public:
  Marching(const Grid& grid, double level) : grid_(grid), level_(level), columns_(grid.columns() + 2), rows_(grid.rows() + 2) {}

  std::vector<Polyline> polygons() {
    for (std::size_t row = 0; row + 1 < rows_; ++row) {
      for (std::size_t column = 0; column + 1 < columns_; ++column) add_cell(column, row);
    }
    std::vector<Polyline> polygons;
    while (!next_.empty()) {
      Polyline polygon;
      for (auto at = next_.begin(); at != next_.end(); at = next_.find(polygon_end_)) {
        polygon.push_back(crossing(at->first));
        polygon_end_ = at->second;
        next_.erase(at);
      }
      polygons.push_back(std::move(polygon));
    }
    return polygons;
  }

 private:
  // An edge of the framed grid: twice the index of its first node, plus one if it is vertical.
  using Edge = std::size_t;

  double value(std::size_t column, std::size_t row) const {
    const bool is_frame = column == 0 || row == 0 || column + 1 == columns_ || row + 1 == rows_;
    return is_frame ? kBelow : grid_.at(column - 1, row - 1);
  }
  Vector2 position(std::size_t column, std::size_t row) const {
    const auto on = [](std::size_t index, std::size_t count) {
      return static_cast<double>(std::clamp<std::size_t>(index, 1, count) - 1);
    };
    return {on(column, grid_.columns()), on(row, grid_.rows())};
  }
  Edge edge(std::size_t column, std::size_t row, bool goes_up) const { return 2 * (row * columns_ + column) + (goes_up ? 1 : 0); }

  Vector2 crossing(Edge edge) const {
    const std::size_t node = edge / 2, column = node % columns_, row = node / columns_;
    const std::size_t column2 = column + (edge % 2 == 0 ? 1 : 0), row2 = row + (edge % 2 == 0 ? 0 : 1);
    const double from = value(column, row), to = value(column2, row2);
    const Vector2 start = position(column, row), end = position(column2, row2);
    if (from == kBelow || to == kBelow) return start;  // both are the same point
    return start + (level_ - from) / (to - from) * (end - start);
  }

  void add_cell(std::size_t column, std::size_t row) {
    const std::array<double, 4> corner = {value(column, row), value(column + 1, row), value(column + 1, row + 1),
                                          value(column, row + 1)};
    const std::array<Edge, 4> side = {edge(column, row, false), edge(column + 1, row, true), edge(column, row + 1, false),
                                      edge(column, row, true)};
    const auto is_in = [&](std::size_t k) { return corner[k % 4] >= level_; };
    // Anticlockwise around the cell, an edge leaves the region or enters it.
    std::array<std::size_t, 2> out{}, in{};
    std::size_t outs = 0, ins = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (is_in(k) && !is_in(k + 1)) out[outs++] = k;
      if (!is_in(k) && is_in(k + 1)) in[ins++] = k;
    }
    if (outs == 1) next_[side[out[0]]] = side[in[0]];
    if (outs < 2) return;
    // Two opposite corners are in the region. It is one piece or two.
    const bool is_connected = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]) >= level_;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t after = (out[k] + 1) % 4, before = (out[k] + 3) % 4;
      next_[side[out[k]]] = side[is_connected ? after : before];
    }
  }

  const Grid& grid_;
  double level_;
  std::size_t columns_, rows_;
  std::map<Edge, Edge> next_;
  Edge polygon_end_ = 0;
};

double distance_from_segment(const Vector2& point, const Vector2& start, const Vector2& end) {
  const Vector2 along = end - start;
  const double squared = along.squaredNorm();
  const double share = squared > 0 ? std::clamp((point - start).dot(along) / squared, 0.0, 1.0) : 0;
  return (point - start - share * along).norm();
}

void keep_farthest(const Polyline& line, double error, std::size_t first, std::size_t last, std::vector<bool>& is_kept) {
  double farthest = error;
  std::size_t split = first;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double distance = distance_from_segment(line[k], line[first], line[last]);
    if (distance > farthest) {
      farthest = distance;
      split = k;
    }
  }
  if (split == first) return;
  is_kept[split] = true;
  keep_farthest(line, error, first, split, is_kept);
  keep_farthest(line, error, split, last, is_kept);
}

}  // namespace

void Grid::fill(const std::function<double(double, double)>& value) {
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) {
      values_[row * columns_ + column] = value(static_cast<double>(column), static_cast<double>(row));
    }
  }
}

double Grid::least() const { return *std::ranges::min_element(values_); }
double Grid::most() const { return *std::ranges::max_element(values_); }

std::vector<Polyline> superlevel_polygons(const Grid& grid, double level) { return Marching(grid, level).polygons(); }

std::vector<Polyline> without_border(const std::vector<Polyline>& polygons, const Grid& grid) {
  const auto last_column = static_cast<double>(grid.columns() - 1), last_row = static_cast<double>(grid.rows() - 1);
  const auto is_border = [&](const Vector2& a, const Vector2& b) {
    const auto both = [](double p, double q, double border) { return p == border && q == border; };
    return both(a.x(), b.x(), 0) || both(a.x(), b.x(), last_column) || both(a.y(), b.y(), 0) || both(a.y(), b.y(), last_row);
  };
  std::vector<Polyline> lines;
  for (const Polyline& polygon : polygons) {
    const std::size_t count = polygon.size();
    // Start after an edge on the border, if there is one, so that no line is split.
    std::size_t start = 0;
    while (start < count && !is_border(polygon[start], polygon[(start + 1) % count])) ++start;
    Polyline line;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2 &a = polygon[(start + k) % count], &b = polygon[(start + k + 1) % count];
      if (is_border(a, b)) {
        if (line.size() > 1) lines.push_back(line);
        line.clear();
        continue;
      }
      if (line.empty()) line.push_back(a);
      line.push_back(b);
    }
    if (line.size() > 1) lines.push_back(line);
  }
  return lines;
}

Polyline simplified(const Polyline& line, double error) {
  if (line.size() < 3) return line;
  std::vector<bool> is_kept(line.size(), false);
  is_kept.front() = is_kept.back() = true;
  keep_farthest(line, error, 0, line.size() - 1, is_kept);
  Polyline kept;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (is_kept[k]) kept.push_back(line[k]);
  }
  return kept;
}

double round_step(double range, int parts) {
  const double power = std::pow(10, std::floor(std::log10(range / parts)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * parts >= range) return factor * power;
  }
  return 10 * power;
}

}  // namespace explain_pair
