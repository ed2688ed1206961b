// What faces and sides rest on: flat ground, and the inside of a pipe.
#pragma once

#include <limits>
#include <span>

#include "kernel/face.hpp"

namespace granular {

/// A convex polygon of a plane, counter-clockwise, m.
using Patch = std::span<const Vector2>;

/// A plane, or what there is of it.
struct Ground {
  Matrix3 frame;                     ///< columns: two axes in the plane, and the normal out of the ground; right-handed
  Vector3 origin;                    ///< m; a point of the plane
  std::span<const Patch> patches{};  ///< without common points, from `origin`, along both axes; all of the plane without patches
  /// Whether patches are the coplanar triangles of a surface, which bear a body as their plane if they are all under it. Otherwise
  /// there is one patch, which bears the part of the body over it.
  bool is_surface = false;
  double width = std::numeric_limits<double>::infinity();  ///< m; of the patch
  double tilt = std::numeric_limits<double>::infinity();   ///< rad; as in Face

  /// The plane through a point (m). `normal` is unit, out of the ground.
  static Ground plane(const Vector3& point, const Vector3& normal);
};

/// The inside of an infinite cylinder.
struct Pipe {
  Vector3 point;  ///< m; of the axis
  Vector3 axis;   ///< unit
  double radius;  ///< m
};

}  // namespace granular
