// The classes of superellipsoids of the reference file (reference_pairs.hpp), from which more are drawn.
#pragma once

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

}  // namespace supernormal::test
