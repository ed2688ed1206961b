// Which poses can be computed with.
#pragma once

#include "shapes/finite.hpp"
#include "supernormal/proximity/pose.hpp"

namespace supernormal {

/// m; the square of what is farther away than this is not finite.
inline constexpr double kFarthest = 1e150;

/// Asked of the entries before anything is computed: products of what is out of range would raise floating-point exceptions.
inline bool is_usable(const Pose& pose) { return all_within(pose.position, kFarthest) && all_finite(pose.rotation); }

}  // namespace supernormal
