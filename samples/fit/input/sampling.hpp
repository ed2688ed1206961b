// Uniform samples of a surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <supernormal/shapes/shape.hpp>
#include <vector>

#include "model/cloud.hpp"

namespace fit {

using Triangle = std::array<std::uint32_t, 3>;

/// `count` random points of the triangles, uniform by area, with the normals of the triangles. The same seed gives the same points.
/// Throws std::invalid_argument if the triangles have no area.
Cloud sample_triangles(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, std::size_t count,
                       std::uint64_t seed);

/// `count` random points on the boundary of a body, in its frame, with normals. The points are exact. They are uniform up to the
/// error of a mesh from which they are projected.
Cloud sample_boundary(const supernormal::Shape& shape, std::size_t count, std::uint64_t seed);

}  // namespace fit
