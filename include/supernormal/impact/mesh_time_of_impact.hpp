// When a body that moves will meet a surface of triangles.
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

/// Finds the first time in [0, horizon] at which a body meets one of the triangles: that of find_time_of_impact() for the first of
/// them. Every triangle counts, from both sides, and nothing behind it: name those that are near the body's way. Their vertices are
/// in the frame of `mesh_motion`, that of its pose. Without any triangle the bodies are apart, and Impact::proximity holds no
/// answer. Errors are those of find_time_of_impact().
SUPERNORMAL_API MeshImpact find_mesh_time_of_impact(const Shape& shape, const Motion& motion,
                                                    std::span<const MeshTriangle> triangles, const Motion& mesh_motion,
                                                    double horizon, const Settings& settings = {});

}  // namespace supernormal
