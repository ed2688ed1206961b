// When a moving body will meet a surface of triangles.
#pragma once

#include <span>

#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/impact/time_of_impact.hpp"

namespace supernormal {

/// The first impact of a body with a triangle.
struct MeshImpact {
  Impact impact;      ///< body 1 is the body, body 2 the triangle
  int triangle = -1;  ///< MeshTriangle::index; -1 without an impact
};

/// Finds the first time in [0, horizon] (s) at which a body meets one of the triangles: the first impact that find_time_of_impact()
/// finds with any of them. Every triangle counts, from both sides, and nothing is solid behind it. Pass the triangles near the
/// body's path. Their vertices are in the frame of `mesh_motion`, the moving surface. Without triangles the bodies are apart, and
/// Impact::proximity holds no answer. The errors are the errors of find_time_of_impact().
SUPERNORMAL_API MeshImpact find_mesh_time_of_impact(const Shape& shape, const Motion& motion,
                                                    std::span<const MeshTriangle> triangles, const Motion& mesh_motion,
                                                    double horizon, const Settings& settings = {});

}  // namespace supernormal
