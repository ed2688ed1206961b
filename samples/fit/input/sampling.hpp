// Points evenly spread over a surface.
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

/// `count` random points of the triangles, each as likely as its area, with the triangles' normals. The same seed gives the same
/// points. std::invalid_argument when the triangles have no area.
Cloud sample_triangles(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, std::size_t count,
                       std::uint64_t seed);

/// `count` random points on the boundary of a body, evenly spread but for the error of the mesh that they are spread over, in the
/// body's frame; exact ones, with their normals.
Cloud sample_boundary(const supernormal::Shape& shape, std::size_t count, std::uint64_t seed);

}  // namespace fit
