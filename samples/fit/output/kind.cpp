#include "kind.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "base/toml_string.hpp"
#include "json.hpp"

namespace fit {
namespace {

struct Spread {
  double mean = 0, deviation = 0;
};

Spread spread_of(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  Spread spread;
  for (const double value : values) spread.mean += value / count;
  for (const double value : values) spread.deviation += std::pow(value - spread.mean, 2) / (count - 1);
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

/// The middle one of the three widths of a grain, as in the catalogue: along the axes of a body, or of the data for a union.
double sieve_size(const std::vector<FittedBody>& fitted) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const FittedBody& each : fitted) {
    const DistanceFunction function(each.body);
    for (int i = 0; i < 3; ++i) {
      const Vector3 up = fitted.size() == 1 ? Vector3(Vector3::Unit(i)) : function.to_body(Vector3::Unit(i));
      const double place = fitted.size() == 1 ? 0 : each.body.position[i];
      high[i] = std::max(high[i], place + function.shape().support(up));
      low[i] = std::min(low[i], place - function.shape().support(-up));
    }
  }
  std::array<double, 3> widths = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::ranges::sort(widths);
  return widths[1];
}

/// The elongation and the flatness, as logarithms.
std::array<double, 2> place_of(const Specimen& specimen) {
  const Proportions proportions = proportions_of(specimen.solid);
  return {std::log(proportions.elongation), std::log(proportions.flatness)};
}

std::string row(const std::string& name, double size, const Proportions& proportions) {
  std::array<char, 100> text{};
  std::snprintf(text.data(), text.size(), "%12.4g %12.3f %12.3f %12.3f\n", size, proportions.elongation, proportions.flatness,
                proportions.fullness);
  return "  " + name + std::string(name.size() < 24 ? 24 - name.size() : 1, ' ') + text.data();
}

/// The sieve size of the typical specimen, scaled to the volume of each.
std::vector<double> lengths_of(std::span<const Specimen> specimens) {
  const Specimen& typical = specimens[typical_of(specimens)];
  const double length = sieve_size(typical.fitted);
  std::vector<double> lengths;
  for (const Specimen& each : specimens) lengths.push_back(length * std::cbrt(each.solid.volume / typical.solid.volume));
  return lengths;
}

}  // namespace

Proportions proportions_of(const Solid& solid) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(solid.inertia, Eigen::EigenvaluesOnly);
  // The moments I ascend, so the half-axes descend: the square of each is 5/2 (sum of I - 2 I) per volume.
  const Vector3& moments = eigen.eigenvalues();
  const Vector3 axes = (2.5 / solid.volume * (moments.sum() - 2 * moments.array())).sqrt();
  return {axes[1] / axes[0], axes[2] / axes[1], solid.volume / (4 * std::numbers::pi / 3 * axes.prod())};
}

std::size_t typical_of(std::span<const Specimen> specimens) {
  std::array<double, 2> middle{};
  for (const Specimen& each : specimens) {
    for (std::size_t i = 0; i < 2; ++i) middle[i] += place_of(each)[i] / static_cast<double>(specimens.size());
  }
  const auto nearest = std::ranges::min_element(specimens, {}, [&](const Specimen& each) {
    return std::hypot(place_of(each)[0] - middle[0], place_of(each)[1] - middle[1]);
  });
  return static_cast<std::size_t>(nearest - specimens.begin());
}

std::string scene_lines(std::span<const Specimen> specimens, const std::string& name) {
  constexpr double kSame = 1e-6;  // relative; a single precision file rounds by less
  const std::vector<double> lengths = lengths_of(specimens);
  std::vector<double> logarithms(lengths.size());
  std::ranges::transform(lengths, logarithms.begin(), [](double length) { return std::log(length); });
  const Spread spread = spread_of(logarithms);
  std::string text = "[[grain]]\nname = " + falling_particles::toml_string(name) + "\ncount = 100\n";
  const auto [smallest, largest] = std::ranges::minmax(lengths);
  if (!(largest > (1 + kSame) * smallest)) return text;
  std::array<char, 200> size{};
  std::snprintf(
      size.data(), size.size(),
      "size = { distribution = \"lognormal\", median = %.6e, geometric_deviation = %.6f, smallest = %.6e, largest = %.6e }\n",
      std::exp(spread.mean), std::exp(spread.deviation), smallest, largest);
  return text + size.data();
}

std::string describe(std::span<const Specimen> specimens) {
  const std::vector<double> lengths = lengths_of(specimens);
  std::string text = "  scan                     sieve size   elongation     flatness     fullness\n";
  std::array<std::vector<double>, 4> columns;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const Proportions proportions = proportions_of(specimens[i].solid);
    text += row(specimens[i].name, lengths[i], proportions);
    const std::array<double, 4> values = {lengths[i], proportions.elongation, proportions.flatness, proportions.fullness};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(values[k]);
  }
  std::array<Spread, 4> spreads;
  std::ranges::transform(columns, spreads.begin(), spread_of);
  text += row("mean", spreads[0].mean, {spreads[1].mean, spreads[2].mean, spreads[3].mean});
  text += row("standard deviation", spreads[0].deviation, {spreads[1].deviation, spreads[2].deviation, spreads[3].deviation});
  return text + "typical: " + specimens[typical_of(specimens)].name + "\n";
}

}  // namespace fit
