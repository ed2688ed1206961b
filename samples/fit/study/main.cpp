// How well fit recovers bodies that are known: the tables of samples/fit/README.md.
#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "compounds.hpp"
#include "model/fit_body.hpp"
#include "truth.hpp"

namespace {

using fit::Body;
using fit::FittedBody;
using fit::Vector3;

Body make_truth(const Vector3& half_axes, double delta, double epsilon) {
  Body body;
  body.family = fit::Family::Superellipsoid;
  body.half_axes = half_axes;
  body.delta = delta;
  body.epsilon = epsilon;
  body.position = {3, -2, 5};
  body.attitude = Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized();
  return body;
}

/// A fit in the truth's frame, with its standard errors there.
struct Compared {
  Body body;
  fit::Gradient deviation, standard_error;
  std::array<bool, fit::kParameters> is_determined{};
};

Compared compare(const FittedBody& fitted, const Body& truth) {
  Compared result;
  Eigen::Matrix3d axes;
  result.body = fit::aligned(fitted.body, truth, axes);
  result.deviation = fit::deviation(result.body, truth);
  const Eigen::Matrix3d from = axes.cwiseAbs().transpose();
  result.standard_error = fitted.uncertainty.standard_error;
  result.is_determined = fitted.uncertainty.is_determined;
  for (const int first : {fit::kRotation, fit::kLogAxes}) {
    result.standard_error.segment<3>(first) = from * fitted.uncertainty.standard_error.segment<3>(first);
    for (int i = first; i < first + 3; ++i) {
      Eigen::Index source = 0;
      from.row(i - first).maxCoeff(&source);
      result.is_determined[static_cast<std::size_t>(i)] =
          fitted.uncertainty.is_determined[static_cast<std::size_t>(first + source)];
    }
  }
  return result;
}

std::string with_error(const Compared& compared, double value, int parameter) {
  std::array<char, 64> text{};
  if (compared.is_determined[static_cast<std::size_t>(parameter)]) {
    std::snprintf(text.data(), text.size(), "%.5g ± %.2g", value, compared.standard_error[parameter]);
  } else {
    std::snprintf(text.data(), text.size(), "%.5g ± ?", value);
  }
  return text.data();
}

void print_row(const Body& truth, const fit::Scatter& scatter) {
  const FittedBody fitted = fit::fit_body(fit::scatter(truth, scatter), {.family = fit::Family::Superellipsoid});
  const Compared c = compare(fitted, truth);
  double worst = 0;
  for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(c.deviation[fit::kLogAxes + i]) / truth.half_axes[i]);
  std::printf("| %g, %g | %g %% | %s | %s | %s | %s | %s | %s | %.1e%s |\n", truth.delta, truth.epsilon, 100 * scatter.noise,
              scatter.is_half_missing ? "half" : "whole", with_error(c, c.body.delta, fit::kLogDelta).c_str(),
              with_error(c, c.body.epsilon, fit::kLogEpsilon).c_str(), with_error(c, c.body.half_axes[0], fit::kLogAxes).c_str(),
              with_error(c, c.body.half_axes[1], fit::kLogAxes + 1).c_str(),
              with_error(c, c.body.half_axes[2], fit::kLogAxes + 2).c_str(), worst,
              fitted.is_edge_below_noise ? ", edge below noise" : "");
  std::fflush(stdout);
}

void print_recovery() {
  std::puts("half-axes 1.5, 1.1, 0.8; 2000 points (1000 of a half body)\n");
  std::puts("| true delta, epsilon | noise | data | delta | epsilon | a | b | c | worst half-axis |");
  std::puts("|---|---|---|---|---|---|---|---|---|");
  constexpr std::array<std::array<double, 2>, 7> kExponents = {
      {{1.2, 1.2}, {1.2, 20}, {2, 2}, {3, 1.5}, {2.5, 4}, {8, 6}, {20, 20}}};
  for (const auto& [delta, epsilon] : kExponents) {
    const Body truth = make_truth({1.5, 1.1, 0.8}, delta, epsilon);
    for (const bool half : {false, true}) {
      for (const double noise : {0.0, 0.01, 0.05}) {
        print_row(truth, {.points = half ? 1000U : 2000U, .noise = noise, .is_half_missing = half, .seed = 3});
      }
    }
  }
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// A body with half-axes that differ, in any attitude, exponents in [1.3, 8].
Body random_truth(std::mt19937_64& random) {
  const auto exponent = [&] { return 1 + std::exp(std::log(0.3) + std::log(7 / 0.3) * uniform(random)); };
  const double a = 1.2 + 0.4 * uniform(random), b = 0.8 + 0.3 * uniform(random), c = 0.4 + 0.3 * uniform(random);
  const std::array<Vector3, 3> orders = {Vector3(a, b, c), Vector3(c, a, b), Vector3(b, c, a)};
  Body body = make_truth(orders[random() % 3], exponent(), exponent());
  body.attitude =
      Eigen::Quaterniond(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5).normalized();
  return body;
}

/// Of how many fits the truth lies within two standard errors. 95.4 % is right.
void print_coverage(int fits, double noise, int points) {
  std::mt19937_64 random(7);
  constexpr std::array kNames = {"centre x", "centre y", "centre z", "turn x", "turn y", "turn z",
                                 "a",        "b",        "c",        "delta",  "epsilon"};
  std::array<int, kNames.size()> within{}, counted{};
  int other_axis = 0, whole = 0, all = 0;
  for (int k = 0; k < fits; ++k) {
    const Body truth = random_truth(random);
    const fit::Scatter scatter{.points = static_cast<std::size_t>(points), .noise = noise, .seed = random() % 1000000};
    const FittedBody fitted = fit::fit_body(fit::scatter(truth, scatter), {.family = fit::Family::Superellipsoid});
    const Compared c = compare(fitted, truth);
    // With exponents that are nearly the same, noise may make a body with another axis for z fit a little better.
    if (std::abs(c.deviation[fit::kRotation]) + std::abs(c.deviation[fit::kRotation + 1]) > 0.7) {
      ++other_axis;
      continue;
    }
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (!c.is_determined[i]) continue;
      ++counted[i];
      if (std::abs(c.deviation[static_cast<Eigen::Index>(i)]) <= 2 * c.standard_error[static_cast<Eigen::Index>(i)]) ++within[i];
    }
  }
  std::printf(
      "%d fits of %d points, noise %g %%; %d took another axis for z\n\n| number | determined | within 2 standard errors "
      "|\n|---|---|---|\n",
      fits, points, 100 * noise, other_axis);
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    std::printf("| %s | %d | %.1f %% |\n", kNames[i], counted[i], 100.0 * within[i] / std::max(1, counted[i]));
    whole += within[i];
    all += counted[i];
  }
  std::printf("| all | %d | %.1f %% |\n", all, 100.0 * whole / std::max(1, all));
}

void print_time() {
  std::puts("100 000 points, one thread\n\n| true body | noise | shape | processor time, s |\n|---|---|---|---|");
  constexpr std::array<std::array<double, 2>, 3> kExponents = {{{2, 2}, {2.5, 4}, {8, 6}}};
  for (const auto& [delta, epsilon] : kExponents) {
    for (const double noise : {0.0, 0.01}) {
      const fit::Cloud cloud = fit::scatter(make_truth({1.5, 1.1, 0.8}, delta, epsilon), {.points = 100000, .noise = noise});
      for (const bool is_chosen : {true, false}) {
        fit::FitSettings settings;
        if (is_chosen) settings.family = fit::Family::Superellipsoid;
        const std::clock_t start = std::clock();
        fit::fit_body(cloud, settings);
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        std::printf("| %g, %g | %g %% | %s | %.2f |\n", delta, epsilon, 100 * noise, is_chosen ? "superellipsoid" : "auto",
                    seconds);
        std::fflush(stdout);
      }
    }
  }
}

void write_points(const std::string& path, const std::vector<Vector3>& points) {
  std::ofstream file(path);
  for (const Vector3& x : points) file << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

int run_program(int argc, char** argv) {
  CLI::App app("Fits bodies that are known.", "fit_study");
  app.require_subcommand(1);
  CLI::App* const recovery = app.add_subcommand("recovery", "true and recovered numbers, whole and half bodies, with noise");
  CLI::App* const coverage = app.add_subcommand("coverage", "how often the truth lies within two standard errors");
  int fits = 100, points = 1000;
  double noise = 0.01;
  coverage->add_option("--fits", fits)->check(CLI::Range(1, 100000))->capture_default_str();
  coverage->add_option("--points", points)->check(CLI::Range(100, 1000000))->capture_default_str();
  coverage->add_option("--noise", noise, "over the mean half-axis")->check(CLI::Range(0.0, 1.0))->capture_default_str();
  CLI::App* const time = app.add_subcommand("time", "processor time of 100 000 points");
  CLI::App* const compound = app.add_subcommand("compound", "writes points of a body of samples/compound");
  std::string name, path;
  double sigma = 0.0003;
  std::size_t each = 4000;
  compound->add_option("name", name, "dumbbell or molar")->required();
  compound->add_option("file", path, "NAME.xyz, written")->required();
  compound->add_option("--sigma", sigma, "m, noise in every direction")->check(CLI::NonNegativeNumber)->capture_default_str();
  compound->add_option("--points", each, "of each of its parts")->check(CLI::Range(100, 1000000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (*recovery) print_recovery();
  if (*coverage) print_coverage(fits, noise, points);
  if (*time) print_time();
  if (*compound) write_points(path, fit::scatter_union(fit::make_compound(name), each, sigma, 1).points);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fit_study: %s\n", error.what());
    return 1;
  }
}
