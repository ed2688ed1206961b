#include "empty_space.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "distance.hpp"
#include "point_tree.hpp"

namespace fit {

constexpr double kCell = 0.06;  // edge of a cell of the grid, for data of extent 1

/// The signed distance from the data, and from the points that close their holes, at the vertices of cubes; positive outside.
struct DistanceGrid {
  Vector3 low;                 // the first vertex
  std::array<int, 3> counts;   // of vertices
  std::vector<double> values;  // x varies fastest

  std::size_t index(int i, int j, int k) const {
    const auto nx = static_cast<std::size_t>(counts[0]), ny = static_cast<std::size_t>(counts[1]);
    return static_cast<std::size_t>(i) + nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
  }

  void for_each_vertex(const auto& visit) const {
    for (int k = 0; k < counts[2]; ++k) {
      for (int j = 0; j < counts[1]; ++j) {
        for (int i = 0; i < counts[0]; ++i) visit(std::array<int, 3>{i, j, k}, Vector3(low + kCell * Vector3(i, j, k)));
      }
    }
  }
};

namespace {

constexpr std::size_t kSurfacePoints = 2000;  // of the winding number
constexpr std::size_t kNeighbours = 12;       // of a plane through neighbours
constexpr int kSightDirections = 60;

/// The normal of the plane through points, of either sign.
Vector3 plane_normal(const std::vector<Vector3>& points, const std::vector<std::uint32_t>& chosen) {
  Vector3 mean = Vector3::Zero();
  for (const std::uint32_t i : chosen) mean += points[i] / static_cast<double>(chosen.size());
  Matrix3 scatter = Matrix3::Zero();
  for (const std::uint32_t i : chosen) scatter += (points[i] - mean) * (points[i] - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Matrix3>(scatter).eigenvectors().col(0);
}

/// The mean of the directions in which no other point is in sight, as seen from a point: the points are balls of radius `size`.
Vector3 open_side(const std::vector<Vector3>& points, const Vector3& x, double size) {
  static const std::vector<Vector3> directions = spread_directions(kSightDirections);
  std::array<bool, kSightDirections> is_blocked{};
  for (const Vector3& point : points) {
    const Vector3 way = point - x;
    const double square = way.squaredNorm();
    if (square < 4 * size * size) continue;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double along = way.dot(directions[k]);
      if (along > 0 && square - along * along < size * size) is_blocked[k] = true;
    }
  }
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (!is_blocked[k]) sum += directions[k];
  }
  return sum;
}

Surface surface_of(const Cloud& cloud) {
  const Cloud data = thinned(cloud, kSurfacePoints);
  const PointTree tree(data.points);
  Surface surface{data.points, data.normals, {}, 0};
  std::vector<double> sizes;
  std::vector<Vector3> planes;
  for (const Vector3& x : data.points) {
    const std::vector<std::uint32_t> near = tree.nearest(x, kNeighbours);
    const double radius = (data.points[near.back()] - x).norm();
    sizes.push_back(radius);
    surface.areas.push_back(std::numbers::pi * radius * radius / static_cast<double>(near.size()));
    planes.push_back(plane_normal(data.points, near));
  }
  if (!surface.normals.empty()) return surface;
  surface.normals = planes;
  const double size = median(sizes) / 2;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (open_side(data.points, data.points[i], size).dot(planes[i]) < 0) surface.normals[i] *= -1;
  }
  return surface;
}

double threshold_of(const Surface& surface) { return (1 - surface.openness) / 2; }

/// The median distance of points from the plane through their neighbours.
double noise_of(const std::vector<Vector3>& points, const PointTree& tree) {
  std::vector<double> heights;
  const std::size_t step = (points.size() + kSurfacePoints - 1) / kSurfacePoints;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const std::vector<std::uint32_t> near = tree.nearest(points[i], kNeighbours);
    const Vector3 normal = plane_normal(points, near);
    double square = 0;
    for (const std::uint32_t k : near) square += std::pow(normal.dot(points[k] - points[i]), 2);
    heights.push_back(std::sqrt(square / static_cast<double>(near.size())));
  }
  return median(heights);
}

/// A grid around points. Its values are the winding number less its threshold.
DistanceGrid winding_grid(const std::vector<Vector3>& points, const Surface& surface) {
  DistanceGrid grid;
  Vector3 low = points.front(), high = low;
  for (const Vector3& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  grid.low = low.array() - kCell;
  for (int i = 0; i < 3; ++i) grid.counts[static_cast<std::size_t>(i)] = 3 + static_cast<int>((high[i] - low[i]) / kCell);
  grid.for_each_vertex(
      [&](const auto&, const Vector3& x) { grid.values.push_back(winding_number(surface, x) - threshold_of(surface)); });
  return grid;
}

/// Where the winding number crosses its threshold on the edges of a grid, farther from the data than an edge.
std::vector<Vector3> crossings(const DistanceGrid& grid, const PointTree& tree) {
  std::vector<Vector3> points;
  grid.for_each_vertex([&](const std::array<int, 3>& vertex, const Vector3& x) {
    const double here = grid.values[grid.index(vertex[0], vertex[1], vertex[2])];
    for (int axis = 0; axis < 3; ++axis) {
      std::array<int, 3> next = vertex;
      if (++next[static_cast<std::size_t>(axis)] == grid.counts[static_cast<std::size_t>(axis)]) continue;
      const double there = grid.values[grid.index(next[0], next[1], next[2])];
      if ((here < 0) == (there < 0)) continue;
      const Vector3 point = x + kCell * here / (here - there) * Vector3::Unit(axis);
      if (tree.distance(point) > kCell) points.push_back(point);
    }
  });
  return points;
}

}  // namespace

Surface make_surface(const Cloud& cloud) {
  Surface surface = surface_of(cloud);
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < surface.areas.size(); ++i) sum += surface.areas[i] * surface.normals[i];
  surface.openness = sum.norm() / std::accumulate(surface.areas.begin(), surface.areas.end(), 0.0);
  return surface;
}

double winding_number(const Surface& surface, const Vector3& x) {
  double sum = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vector3 way = surface.points[i] - x;
    const double square = way.squaredNorm();
    sum += surface.areas[i] * surface.normals[i].dot(way) / (square * std::sqrt(square));
  }
  return sum / (4 * std::numbers::pi);
}

bool is_outside(const Surface& surface, const Vector3& x) { return winding_number(surface, x) < threshold_of(surface); }

std::vector<Vector3> closing_points(const Cloud& data) {
  return crossings(winding_grid(data.points, make_surface(data)), PointTree(data.points));
}

EmptySpace find_empty_space(const Cloud& data) {
  const PointTree tree(data.points);
  const Surface surface = make_surface(data);
  auto grid = std::make_shared<DistanceGrid>(winding_grid(data.points, surface));
  std::vector<Vector3> all = crossings(*grid, tree);
  all.insert(all.end(), data.points.begin(), data.points.end());
  const PointTree closed(std::move(all));
  std::size_t i = 0;
  grid->for_each_vertex([&](const auto&, const Vector3& x) {
    double& value = grid->values[i++];
    value = value < 0 ? closed.distance(x) : -closed.distance(x);
  });
  const double area = std::accumulate(surface.areas.begin(), surface.areas.end(), 0.0);
  const double spacing = std::sqrt(area / static_cast<double>(data.points.size()));
  const double margin = 2 * noise_of(data.points, tree) + kSpacings * spacing;
  return {.grid = std::move(grid), .margin = margin};
}

EmptySpace::Excess EmptySpace::beyond(const Vector3& x) const {
  if (!grid) return {};
  // Beyond the grid: at its nearest point, and the distance from there.
  const Vector3 place = (scale * x + offset - grid->low) / kCell;
  Vector3 last;
  for (int i = 0; i < 3; ++i) last[i] = grid->counts[static_cast<std::size_t>(i)] - 1;
  const Vector3 inside = place.cwiseMax(0).cwiseMin(last);
  const Vector3 way = kCell * (place - inside);
  std::array<int, 3> cell{};
  Vector3 t;
  for (int i = 0; i < 3; ++i) {
    cell[static_cast<std::size_t>(i)] = std::min(static_cast<int>(inside[i]), static_cast<int>(last[i]) - 1);
    t[i] = inside[i] - cell[static_cast<std::size_t>(i)];
  }
  double value = 0;
  Vector3 slope = Vector3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> up = {corner & 1, (corner >> 1) & 1, corner >> 2};
    const double at = grid->values[grid->index(cell[0] + up[0], cell[1] + up[1], cell[2] + up[2])];
    Vector3 share;
    for (int i = 0; i < 3; ++i) share[i] = up[static_cast<std::size_t>(i)] == 1 ? t[i] : 1 - t[i];
    value += at * share.prod();
    for (int i = 0; i < 3; ++i) {
      const double rest = share[(i + 1) % 3] * share[(i + 2) % 3];
      slope[i] += (up[static_cast<std::size_t>(i)] == 1 ? at : -at) * rest / kCell;
    }
  }
  for (int i = 0; i < 3; ++i) slope[i] = way[i] == 0 ? slope[i] : 0;
  const double far = way.norm(), length = value + far - margin;
  if (!(length > 0)) return {};
  if (far > 0) slope += way / far;
  return {length * (1 + length / steep) / scale, (1 + 2 * length / steep) * slope};
}

EmptySpace moved(const EmptySpace& space, double scale, const Vector3& offset) {
  // y = scale x + offset is the new place, and the place of the grid is s x + o = s / scale (y - offset) + o.
  const double inverse = space.scale / scale;
  EmptySpace result = space;
  result.scale = inverse;
  result.offset -= inverse * offset;
  return result;
}

const std::vector<Vector3>& boundary_directions(bool is_fine) {
  const auto with = [](int between) {
    std::vector<Vector3> all = spread_directions(between);
    for (int i = 0; i < 27; ++i) {
      const int row = i / 3, layer = i / 9;
      const Vector3 u(i % 3 - 1, row % 3 - 1, layer - 1);
      if (i != 13) all.push_back(u.normalized());
    }
    return all;
  };
  static const std::vector<Vector3> rough = with(600), fine = with(20000);
  return is_fine ? fine : rough;
}

double penalty_of(const Body& body, const EmptySpace& space) {
  if (!space.grid) return 0;
  double sum = 0;
  const std::vector<Vector3>& directions = boundary_directions(space.is_fine);
  for (const Vector3& u : directions) {
    const double length = space.beyond(body.position + body.rotation() * boundary_point(body, u)).length;
    sum += length * length;
  }
  return space.weight * sum / static_cast<double>(directions.size());
}

}  // namespace fit
