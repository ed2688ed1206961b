// A test for poses that can be computed with.
#pragma once

#include "shapes/finite.hpp"
#include "supernormal/proximity/pose.hpp"

namespace supernormal {

/// m; the square of a larger distance is not finite.
inline constexpr double kFarthest = 1e150;

/// Whether the numbers of a pose are in range. It looks at them one by one, because products of numbers out of range would raise
/// floating-point exceptions.
inline bool is_usable(const Pose& pose) { return all_within(pose.position, kFarthest) && all_finite(pose.rotation); }

}  // namespace supernormal
