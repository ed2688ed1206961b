// Cases that are hard by the bodies.
#include <cmath>

#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

// Exponents at the ends of their range, and near 2, where the formulas change.

const char* reason_of(double exponent) {
  if (exponent < 1.5) return "vertices and edges attract all normals: the dual exponent is 50 to 100";
  if (exponent < 3) return "another path than that of 2 exactly: both must agree";
  return "the boundary point is the 0.02nd to 0.001st power of the normal: faces jump, edges are sharp";
}

void add_both_gaps(std::vector<HardCase>& cases, const std::string& name, const std::string& reason, const Body& body1,
                   const Body& body2) {
  for (const double gap : {0.125, -0.0625}) {
    cases.push_back(
        on_normal(name + (gap > 0 ? ", apart" : ", overlapping"), reason, body1, Vector3(1, 0.7, 1.6), body2, askew(), gap));
  }
}

// Needles and coins: radii of curvature from 1e-4 to 1e4 times the size, with tolerances relative to the smallest half-axis.

struct Proportion {
  const char* name;
  double thin;  // m; the long half-axes are 1 m
};

constexpr Proportion kProportions[] = {{"1:100", 0.01}, {"1:1e4", 1e-4}};

void add_needles(std::vector<HardCase>& cases, const Proportion& proportion, double exponent) {
  const double thin = proportion.thin;
  const std::string theme = "needles " + std::string(proportion.name) + " (" + text(exponent) + "): ";
  const Body needle = superellipsoid({1, thin, thin}, exponent, exponent);
  const auto add = [&](const std::string& what, const std::string& reason, const Vector3& n, const Matrix3& rotation2, double gap) {
    cases.push_back(on_normal(theme + what, reason, needle, n, needle, rotation2, gap));
  };
  add("crossed, apart", "the common normal is fixed only along one of two needles each", Vector3::UnitZ(),
      turned(Vector3::UnitZ(), kQuarterTurn), thin);
  add("crossed, overlapping", "overlap of half of the thickness, a ten-thousandth of the length", Vector3::UnitZ(),
      turned(Vector3::UnitZ(), kQuarterTurn), -0.5 * thin);
  add("nearly parallel, apart", "a turn of 1e-3 moves the witness points along the needle", Vector3(0, 1, 3),
      turned(Vector3::UnitZ(), 1e-3), 0.1 * thin);
  add("tip to tip", "the radius of curvature there is the square of the thickness", Vector3(1, 0.3, -0.2), askew(), 0.01 * thin);
  add("tip on the side", "the sharpest and the flattest point of the body", Vector3::UnitZ(),
      turned(Vector3::UnitY(), kQuarterTurn), -0.1 * thin);
}

void add_coins(std::vector<HardCase>& cases, const Proportion& proportion, double exponent) {
  const double thin = proportion.thin;
  const std::string theme = "coins " + std::string(proportion.name) + " (2, " + text(exponent) + "): ";
  const Body coin = superellipsoid({1, 1, thin}, 2, exponent);
  cases.push_back(pair(theme + "stacked", "wide faces; the way out sideways is 1e4 times as long", coin, coin,
                       at({0.125, 0, 1.5 * thin}), exponent > 2 ? std::optional<double>() : std::nullopt));
  cases.push_back(on_normal(theme + "rim on face", "the sharpest and the flattest point of the body", coin, Vector3::UnitZ(), coin,
                            turned(Vector3::UnitX(), kQuarterTurn), -0.1 * thin));
  cases.push_back(on_normal(theme + "rim to rim, crossed", "two sharp edges at right angles", coin, Vector3::UnitX(), coin,
                            turned(Vector3::UnitX(), kQuarterTurn), 0.1 * thin));
  cases.push_back(pair(theme + "stuck in one another at right angles", "each halves the other: the ways out are along the edges",
                       coin, coin, at({1, 0.125, 0}, turned(Vector3(1, 0.1, 0), kQuarterTurn))));
}

// Extreme sizes: a grain of a micrometre against a body of a kilometre, and the ends of the range that shapes accept.

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

// Superovoids at the limit of convexity, rounded bodies, bodies with only two functions.

void add_three(std::vector<HardCase>& cases, const std::string& name, const std::string& reason, const Body& body) {
  cases.push_back(on_normal(name + ", apart", reason, body, Vector3(1, -0.5, 0.5), body, askew(), 0.125));
  cases.push_back(on_normal(name + ", touching", reason, body, Vector3(1, -0.5, 0.5), body, askew(), 0));
  cases.push_back(on_normal(name + ", overlapping", reason, body, Vector3(1, -0.5, 0.5), body, askew(), -0.0625));
}

}  // namespace

std::vector<HardCase> exponent_cases() {
  std::vector<HardCase> cases;
  for (const double exponent : {1.01, 1.02, 2 - 1e-6, 2 - 1e-15, 2 + 1e-15, 2 + 1e-6, 50., 200., 1000.}) {
    const double beside = exponent - 2;
    const std::string name = std::abs(beside) > 0.5 ? text(exponent) : (beside > 0 ? "2 + " : "2 - ") + text(std::abs(beside));
    const Body body = superellipsoid(kLengths, exponent, exponent);
    add_both_gaps(cases, "exponents: " + name, reason_of(exponent), body, body);
  }
  const std::string reason = "delta and epsilon at opposite ends: flat one way, sharp the other";
  const Body spindle = superellipsoid(kLengths, 1000, 1.01), plate = superellipsoid(kLengths, 1.01, 1000);
  add_both_gaps(cases, "exponents: 1000, 1.01", reason, spindle, spindle);
  add_both_gaps(cases, "exponents: 1.01, 1000", reason, plate, plate);
  add_both_gaps(cases, "exponents: 1000, 1.01 against 1.01, 1000", reason, spindle, plate);
  add_both_gaps(cases, "exponents: 2, 1000 against 1000, 2", reason, superellipsoid(kLengths, 2, 1000),
                superellipsoid(kLengths, 1000, 2));
  add_both_gaps(cases, "exponents: 1.01 against 1000", "nearly an octahedron and nearly a box",
                superellipsoid(kLengths, 1.01, 1.01), superellipsoid(kLengths, 1000, 1000));
  return cases;
}

std::vector<HardCase> aspect_ratio_cases() {
  std::vector<HardCase> cases;
  for (const Proportion& proportion : kProportions) {
    for (const double exponent : {1.3, 8.}) add_needles(cases, proportion, exponent);
    for (const double exponent : {2., 20.}) add_coins(cases, proportion, exponent);
    const double thin = proportion.thin;
    cases.push_back(pair("needle through a coin " + std::string(proportion.name),
                         "the needle has to leave by its own length, or sideways through the rim", ellipsoid({1, 1, thin}),
                         ellipsoid({thin, thin, 1}), at({0.125, 0.25, 0.5})));
  }
  return cases;
}

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

std::vector<HardCase> other_shape_cases() {
  std::vector<HardCase> cases;
  add_three(cases, "superovoids: egg", "no centre of symmetry", superovoid(kDyadicLengths, 2, 2, 0.3, 0.3));
  add_three(cases, "superovoids: at the limit of convexity", "a radius of curvature is infinite there",
            superovoid(kDyadicLengths, 2, 2, 0.7071, 0.7071));
  add_three(cases, "superovoids: truncated pyramid", "flat faces that are not parallel",
            superovoid(kDyadicLengths, 40, 40, 0.5, 0.5));
  add_three(cases, "superovoids: wedge", "tapered the opposite way along y", superovoid(kDyadicLengths, 4, 2, 0.4, -0.4));
  add_three(cases, "rounded: boxy (60)", "two scales of curvature in one body",
            superellipsoid(kDyadicLengths, 60, 60).rounded(0.01));
  add_three(cases, "rounded: octahedral (1.02)", "a vertex that is a tiny sphere",
            superellipsoid(kDyadicLengths, 1.02, 1.02).rounded(1e-6));
  add_three(cases, "callbacks: ellipsoid", "no Hessian: curvature comes from secants", ellipsoid(kDyadicLengths).by_callbacks());
  add_three(cases, "callbacks: boxy (20)", "no Hessian, and no way to move along a flat face",
            superellipsoid(kDyadicLengths, 20, 20).by_callbacks());
  add_three(cases, "callbacks: octahedral (1.1)", "no Hessian: secants jump between the vertices",
            superellipsoid(kDyadicLengths, 1.1, 1.1).by_callbacks());
  return cases;
}

}  // namespace supernormal::samples
