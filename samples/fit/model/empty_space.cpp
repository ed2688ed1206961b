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
namespace {

constexpr std::size_t kSurfacePoints = 2000;  // of the winding number
constexpr std::size_t kNeighbours = 12;       // of a plane through neighbours
constexpr int kSightDirections = 60;
constexpr int kHalfSpaces = 200;
constexpr std::size_t kBalls = 800;  // that touch the surface
constexpr double kFar = 100;         // radius of the balls that are half-spaces: they bulge by 1/200 of the extent

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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

}  // namespace

Surface make_surface(const Cloud& cloud) {
  const Cloud data = thinned(cloud, kSurfacePoints);
  const PointTree tree(data.points);
  Surface surface{data.points, data.normals, {}, 0};
  std::vector<double> sizes, heights;
  std::vector<Vector3> planes;
  for (const Vector3& x : data.points) {
    const std::vector<std::uint32_t> near = tree.nearest(x, kNeighbours);
    const double radius = (data.points[near.back()] - x).norm();
    sizes.push_back(radius);
    surface.areas.push_back(std::numbers::pi * radius * radius / static_cast<double>(near.size()));
    planes.push_back(plane_normal(data.points, near));
    double square = 0;
    for (const std::uint32_t i : near) square += std::pow(planes.back().dot(data.points[i] - x), 2);
    heights.push_back(std::sqrt(square / static_cast<double>(near.size())));
  }
  surface.noise = median_of(heights);
  if (!surface.normals.empty()) return surface;
  surface.normals = planes;
  const double size = median_of(sizes) / 2;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (open_side(data.points, data.points[i], size).dot(planes[i]) < 0) surface.normals[i] *= -1;
  }
  return surface;
}

double winding_number(const Surface& surface, const Vector3& x) {
  double sum = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vector3 way = surface.points[i] - x;
    sum += surface.areas[i] * surface.normals[i].dot(way) / std::pow(way.squaredNorm(), 1.5);
  }
  return sum / (4 * std::numbers::pi);
}

EmptySpace find_empty_space(const Cloud& data) {
  const PointTree all(data.points);
  const Surface surface = make_surface(data);
  const double area = std::accumulate(surface.areas.begin(), surface.areas.end(), 0.0);
  // The vertices and edges of a body lie between the points, by up to twice their mean spacing.
  const double spacing = std::sqrt(area / static_cast<double>(data.points.size()));
  const double margin = 2 * (surface.noise + spacing);
  EmptySpace space;
  const auto add = [&](const Vector3& centre) {
    const double radius = all.distance(centre) - margin;
    if (!(radius > 0)) return;
    space.centres.push_back(centre);
    space.radii.push_back(radius);
  };
  for (const Vector3& direction : spread_directions(kHalfSpaces)) add(kFar * direction);
  constexpr std::array kHeights = {0.05, 0.1, 0.2, 0.4, 0.8};
  for (std::size_t i = 0; i < std::min(surface.points.size(), kBalls); ++i) {
    // One ball at each point: neighbours have those of other heights.
    const double height = kHeights[i % kHeights.size()];
    const Vector3 centre = surface.points[i] + height * surface.normals[i];
    // Elsewhere the ball touches another part of the surface, whose own balls are nearer to it.
    const bool touches = all.distance(centre) > 0.5 * height;
    if (touches && winding_number(surface, centre) < 0.5) add(centre);
  }
  return space;
}

EmptySpace moved(const EmptySpace& space, double scale, const Vector3& offset) {
  EmptySpace result = space;
  for (Vector3& centre : result.centres) centre = scale * centre + offset;
  for (double& radius : result.radii) radius *= scale;
  return result;
}

EmptySpace thinned(const EmptySpace& space, std::size_t step) {
  EmptySpace result;
  for (std::size_t i = 0; i < space.centres.size(); i += step) {
    result.centres.push_back(space.centres[i]);
    result.radii.push_back(space.radii[i]);
  }
  return result;
}

double penalty_of(const Body& body, const EmptySpace& space) {
  if (space.centres.empty()) return 0;
  const DistanceFunction function(body, kRoughTolerance);
  double sum = 0;
  for (std::size_t i = 0; i < space.centres.size(); ++i) {
    if (function.is_farther(space.centres[i], space.radii[i])) continue;
    const std::optional<Witness> witness = function.find(space.centres[i]);
    if (witness) sum += std::pow(std::max(0.0, space.radii[i] - witness->distance), 2);
  }
  return kEmptyWeight * sum / static_cast<double>(space.centres.size());
}

}  // namespace fit
