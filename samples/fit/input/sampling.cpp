#include "sampling.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <supernormal/proximity/solve.hpp>
#include <supernormal/shapes/sphere.hpp>
#include <supernormal/shapes/tessellation.hpp>

namespace fit {

Cloud sample_triangles(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, std::size_t count,
                       std::uint64_t seed) {
  std::vector<double> sums;
  double sum = 0;
  const auto normal_of = [&](const Triangle& t) -> Eigen::Vector3d {
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
  };
  for (const Triangle& triangle : triangles) sums.push_back(sum += normal_of(triangle).norm());
  if (!(sum > 0)) throw std::invalid_argument("the triangles have no area");
  std::mt19937_64 random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const auto found = std::ranges::upper_bound(sums, sum * uniform(random));
    const Triangle& t = triangles[std::min(static_cast<std::size_t>(found - sums.begin()), triangles.size() - 1)];
    const double root = std::sqrt(uniform(random)), v = uniform(random);
    cloud.points.emplace_back((1 - root) * points[t[0]] + root * (1 - v) * points[t[1]] + root * v * points[t[2]]);
    cloud.normals.push_back(normal_of(t).normalized());
  }
  return cloud;
}

Cloud sample_boundary(const supernormal::Shape& shape, std::size_t count, std::uint64_t seed) {
  const Eigen::Vector3d extents = shape.half_extents();
  // A needle or a coin would need millions of triangles, or a smaller chord error than tessellate() takes.
  const auto mesh = supernormal::tessellate(shape, std::max(2e-3 * extents.minCoeff(), 1e-5 * extents.maxCoeff()));
  Cloud cloud = sample_triangles(mesh.points, mesh.triangles, count, seed);
  const supernormal::Sphere point(0);
  supernormal::Settings settings;
  settings.tolerance = 1e-13;
  for (std::size_t i = 0; i < count; ++i) {
    // The chord is inside the body. The nearest boundary point is above it along the normal.
    const auto nearest =
        supernormal::find_proximity(shape, {}, point, {cloud.points[i], supernormal::Matrix3::Identity()}, settings);
    cloud.points[i] -= nearest.gap * nearest.normal;
    cloud.normals[i] = nearest.normal;
  }
  return cloud;
}

}  // namespace fit
