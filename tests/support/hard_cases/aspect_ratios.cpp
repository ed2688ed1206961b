// Needles and coins: radii of curvature from 1e-4 to 1e4 times the size, with tolerances relative to the smallest half-axis.
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

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

}  // namespace

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

}  // namespace supernormal::samples
