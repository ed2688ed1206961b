// Extreme sizes: a grain of a micrometre against a body of a kilometre, and the ends of the range that shapes accept.
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

constexpr double kGrain = 1e-6, kMountain = 1e3;  // m

void add_grain_on_mountain(std::vector<HardCase>& cases, const std::string& what, const Body& grain, const Body& mountain) {
  const std::string reason = "rounding of the large body is the size of the small one's tolerance: the error has to say so";
  const std::string theme = "sizes: " + what;
  cases.push_back(on_normal(theme + ", apart", reason, mountain, Vector3(1, 2, 3), grain, askew(), kGrain));
  cases.push_back(on_normal(theme + ", touching", reason, mountain, Vector3(1, 2, 3), grain, askew(), 0));
  cases.push_back(on_normal(theme + ", overlapping", reason, mountain, Vector3(1, 2, 3), grain, askew(), -0.1 * kGrain));
  cases.push_back(on_normal(theme + ", 1 km apart", "the sum of the bodies is a point seen from there", mountain, Vector3(1, 2, 3),
                            grain, askew(), kMountain));
}

/// The same two bodies with all lengths multiplied by `unit`.
void add_at_the_end(std::vector<HardCase>& cases, double unit) {
  const std::string reason = "squares and products of lengths come near the ends of the range of numbers";
  const Vector3 half_axes = unit * Vector3(1, 0.75, 0.5);
  for (const double exponent : {1.1, 2., 30.}) {
    const Body body = superellipsoid(half_axes, exponent, exponent);
    const std::string theme = "sizes: half-axes of " + text(unit) + " m (" + text(exponent) + ")";
    cases.push_back(on_normal(theme + ", apart", reason, body, Vector3(1, 1, 2), body, askew(), 0.125 * unit));
    // Octahedra are separated sideways, which is shorter.
    const std::optional<double> known = exponent < 2 ? std::nullopt : std::optional(-0.0625 * unit);
    cases.push_back(pair(theme + ", overlapping", reason, body, body, at({0, 0, 0.9375 * unit}), known));
  }
}

}  // namespace

std::vector<HardCase> size_cases() {
  std::vector<HardCase> cases;
  const Vector3 proportions(1, 0.75, 0.5);
  add_grain_on_mountain(cases, "an ellipsoid of 1e-6 m on one of 1e3 m", ellipsoid(kGrain * proportions),
                        ellipsoid(kMountain * proportions));
  add_grain_on_mountain(cases, "a boxy grain of 1e-6 m on a boxy body of 1e3 m", superellipsoid(kGrain * proportions, 20, 20),
                        superellipsoid(kMountain * proportions, 20, 20));
  add_grain_on_mountain(cases, "an octahedral grain of 1e-6 m on a box of 1e3 m", superellipsoid(kGrain * proportions, 1.1, 1.1),
                        box(kMountain * proportions));
  add_at_the_end(cases, 1e-29);
  add_at_the_end(cases, 1e30);
  return cases;
}

}  // namespace supernormal::samples
