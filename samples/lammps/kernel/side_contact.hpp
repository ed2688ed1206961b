// The contacts of straight sides: with flat ground, and with each other.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "kernel/body.hpp"
#include "kernel/face_contact.hpp"

namespace granular {

/// A convex polygon of a plane, counter-clockwise, m.
using Patch = std::span<const Vector2>;

/// The flat ground under a side.
struct Ground {
  Matrix3 frame;                     ///< columns: two axes in the plane, and the normal out of the ground; right-handed
  Vector3 origin;                    ///< m; a point of the plane
  std::span<const Patch> patches{};  ///< what there is of the plane, from `origin`, along both axes; all of it without patches
  double width = std::numeric_limits<double>::infinity();  ///< m; of the patches
  double tilt = std::numeric_limits<double>::infinity();   ///< rad; as in Face
};

/// The contact of a body's side with the ground. The common line has two corners, its ends, with half of the weight each. Nothing
/// if the body has no side there, or if `share` is 0.
std::optional<FaceContact> find_side_contact(const Body& body, const Ground& ground);

/// The contact of two sides that run around their bodies, such as two cans with parallel axes. Each end of the common line has
/// the depth of the two sections across the mean axis. `normal` (unit, from body 1 to body 2) is a guess. `share` also falls if
/// the bodies cross, so that the middle of the line is deeper than its ends.
std::optional<FaceContact> find_side_pair_contact(const Body& body1, const Body& body2, const Vector3& normal);

}  // namespace granular
