// The classes of superellipsoids of the reference file (reference_pairs.hpp), from which more are drawn.
#pragma once

#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

namespace supernormal::test {

struct SuperellipsoidClass {
  const char* name;
  double least_axis, largest_axis;  ///< m
  double least_exponent, largest_exponent;
};

/// The soak's seeds refer to their order.
inline constexpr SuperellipsoidClass kSuperellipsoidClasses[] = {
    {"ellipsoid", 0.5, 1.5, 2, 2}, {"needle_disk", 0.05, 5, 2, 2},      {"moderate", 0.5, 1.5, 1.3, 5},
    {"boxy", 0.5, 1.5, 6, 20},     {"extreme_boxy", 0.5, 1.5, 50, 200}, {"octahedral", 0.5, 1.5, 1.02, 1.3},
    {"mixed", 0.5, 1.5, 1.05, 50}, {"needle_mixed", 0.05, 5, 1.02, 200}};

inline Superellipsoid draw_superellipsoid(const SuperellipsoidClass& kind, Draw& draw) {
  const Vector3 half_axes = draw.log_within(kind.least_axis, kind.largest_axis);
  const double delta = draw.log_uniform(kind.least_exponent, kind.largest_exponent);
  return {half_axes, delta, draw.log_uniform(kind.least_exponent, kind.largest_exponent)};
}

}  // namespace supernormal::test
