#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "compare.hpp"
#include "random_body.hpp"
#include "studies.hpp"

namespace fit {
namespace {

constexpr std::array kExponents = {1.2, 1.5, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0};
constexpr std::array kTaperShares = {0.25, 0.5, 0.9};
constexpr std::size_t kPoints = 2000;

/// Relative errors of one kind of parameter over several fits, and the stated standard errors.
struct Errors {
  std::vector<double> sizes, stated;
  double most = 0;  // largest error over its standard error
  int undetermined = 0;

  void add(const Compared& compared, int parameter, double scale) {
    if (!compared.is_determined[static_cast<std::size_t>(parameter)]) {
      ++undetermined;
      return;
    }
    sizes.push_back(std::abs(compared.deviation[parameter]) / scale);
    stated.push_back(compared.standard_error[parameter] / scale);
    most = std::max(most, sizes.back() / stated.back());
  }
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A fraction in per cent. Less than a millionth is rounding.
std::string percent(double share) {
  if (share < 1e-6) return "< 1e-4";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), share < 9.95 ? "%.2g" : "%.0f", 100 * share);
  return text.data();
}

std::string cells(const Errors& errors) {
  if (errors.sizes.empty()) return "– | – | – | " + std::to_string(errors.undetermined);
  return percent(median(errors.sizes)) + " | " + percent(*std::ranges::max_element(errors.sizes)) + " | " +
         percent(median(errors.stated)) + " | " + std::to_string(errors.undetermined);
}

struct Row {
  Errors half_axes, shape;
  int fits = 0, other_axes = 0, edges_below_noise = 0;

  /// `parameter` is the index of the shape parameter of the table.
  void add(const Compared& compared, const Body& truth, int parameter, double scale) {
    ++fits;
    if (compared.is_edge_below_noise) ++edges_below_noise;
    if (compared.has_other_axes) {
      ++other_axes;
      return;
    }
    for (int i = 0; i < 3; ++i) half_axes.add(compared, kLogAxes + i, truth.half_axes[i]);
    shape.add(compared, parameter, scale);
  }

  void print(double value, const Scatter& scatter) const {
    std::printf("| %g | %s | %g %% | %s | %s | %d | %d |\n", value, scatter.is_half_missing ? "half" : "whole", 100 * scatter.noise,
                cells(half_axes).c_str(), cells(shape).c_str(), other_axes, edges_below_noise);
    std::fflush(stdout);
  }
};

/// Prints a row for whole and half bodies with each noise, each from `bodies` fits.
template <typename AddFit>
void print_rows(double value, int bodies, AddFit add_fit) {
  for (const bool is_half : {false, true}) {
    for (const double noise : {0.0, 0.01, 0.05}) {
      std::mt19937_64 random(7);
      Row row;
      Scatter scatter{.points = kPoints, .noise = noise, .is_half_missing = is_half};
      for (int k = 0; k < bodies; ++k) {
        scatter.seed = static_cast<std::uint64_t>(k) + 1;
        add_fit(row, k, random, scatter);
      }
      row.print(value, scatter);
    }
  }
}

void print_head(const char* number) {
  std::printf(
      "| %s | data | noise | half-axes: median error, %% | worst | stated | ? | %s: median error, %% | worst | stated | ? | other "
      "axes | edges below noise |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      number, number);
}

}  // namespace

void print_recovery(int bodies) {
  std::printf("%d bodies a row, %zu points each\n\n", bodies, kPoints);
  print_head("exponent");
  for (const double exponent : kExponents) {
    print_rows(exponent, bodies, [&](Row& row, int k, std::mt19937_64& random, const Scatter& scatter) {
      Body truth = random_superellipsoid(random);
      const bool is_delta = k % 2 == 0;
      (is_delta ? truth.delta : truth.epsilon) = exponent;
      row.add(fit_and_compare(truth, scatter), truth, is_delta ? kLogDelta : kLogEpsilon, exponent);
    });
  }
  std::puts("");
  print_head("taper over its limit");
  for (const double share : kTaperShares) {
    print_rows(share, bodies, [&](Row& row, int, std::mt19937_64& random, const Scatter& scatter) {
      const Body truth = random_superovoid(random, share);
      row.add(fit_and_compare(truth, scatter), truth, kTaper, std::abs(truth.taper));
    });
  }
}

}  // namespace fit
