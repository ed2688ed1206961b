// Measures how well fit recovers known bodies: the tables of samples/fit/constants.md.
#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "kind/kind_text.hpp"
#include "model/distance.hpp"
#include "model/fit_body.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
#include "truth.hpp"

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
void print_rows(double value, int bodies, auto add_fit) {
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

constexpr std::size_t kCoveragePoints = 1000;

struct Covered {
  Family family;
  double noise;
  bool is_half_missing;
};

struct Kind {
  const char* name;
  int first, count;
};
constexpr std::array<Kind, 5> kKinds = {{{"centre", kPosition, 3},
                                         {"orientation", kRotation, 3},
                                         {"half-axes", kLogAxes, 3},
                                         {"exponents", kLogDelta, 2},
                                         {"taper", kTaper, 1}}};

struct Count {
  int one = 0, two = 0, all = 0, undetermined = 0;

  void add(const Compared& compared, int parameter) {
    if (!compared.is_determined[static_cast<std::size_t>(parameter)]) {
      ++undetermined;
      return;
    }
    const double ratio = std::abs(compared.deviation[parameter]) / compared.standard_error[parameter];
    ++all;
    if (ratio <= 1) ++one;
    if (ratio <= 2) ++two;
  }

  void print() const {
    if (all == 0) {
      std::printf(" – |");
    } else {
      std::printf(" %.0f, %.0f |", 100.0 * one / all, 100.0 * two / all);
    }
  }
};

void print_covered(const Covered& chosen, int bodies) {
  std::mt19937_64 random(11);
  std::array<Count, kKinds.size()> counts;
  Count below_noise;  // exponents of bodies with edges below the noise
  int other_axes = 0, edges_below_noise = 0;
  for (int k = 0; k < bodies; ++k) {
    const bool is_ovoid = chosen.family == Family::Superovoid;
    const Body truth = is_ovoid ? random_superovoid(random, 0.5) : random_superellipsoid(random);
    const Compared compared = fit_and_compare(truth, {.points = kCoveragePoints,
                                                      .noise = chosen.noise,
                                                      .is_half_missing = chosen.is_half_missing,
                                                      .seed = static_cast<std::uint64_t>(k) + 1});
    if (compared.has_other_axes) {
      ++other_axes;
      continue;
    }
    if (compared.is_edge_below_noise) {
      ++edges_below_noise;
      for (const int parameter : {kLogDelta, kLogEpsilon}) below_noise.add(compared, parameter);
      continue;
    }
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
      if (kKinds[i].first == kTaper && !is_ovoid) continue;
      for (int j = 0; j < kKinds[i].count; ++j) counts[i].add(compared, kKinds[i].first + j);
    }
  }
  int undetermined = 0;
  std::printf("| %s | %s | %g %% |", name_of(chosen.family), chosen.is_half_missing ? "half" : "whole", 100 * chosen.noise);
  for (const Count& count : counts) {
    count.print();
    undetermined += count.undetermined;
  }
  std::printf(" %d | %d | %d |", undetermined, other_axes, edges_below_noise);
  below_noise.print();
  std::puts("");
  std::fflush(stdout);
}

constexpr std::size_t kPointsOfPart = 1000;
constexpr std::size_t kSurfacePoints = 5000;
constexpr int kLargestCount = 4;

/// The largest distance of the first union's surface from the surface of the second.
double largest_distance(const std::vector<Body>& from, const std::vector<Body>& to) {
  const std::vector<DistanceFunction> own(from.begin(), from.end()), others(to.begin(), to.end());
  double largest = 0;
  for (const Vector3& x : free_surface(own, kSurfacePoints)) largest = std::max(largest, std::abs(least_distance(others, x)));
  return largest;
}

/// The largest relative difference of the principal moments of inertia.
double inertia_error(const Solid& fitted, const Solid& truth) {
  const auto moments = [](const Solid& solid) -> Vector3 {
    return Eigen::SelfAdjointEigenSolver<Matrix3>(solid.inertia, Eigen::EigenvaluesOnly).eigenvalues();
  };
  return (moments(fitted).cwiseQuotient(moments(truth)) - Vector3::Ones()).cwiseAbs().maxCoeff();
}

void print_row(const char* name, Family family, double sigma) {
  const std::vector<Body> truth = make_compound(name);
  const Cloud cloud = scatter_union(truth, kPointsOfPart, sigma, 1);
  FitSettings settings;
  settings.family = family;
  const std::clock_t start = std::clock();
  const std::vector<FittedBody> fitted = fit_union(cloud, kLargestCount, settings);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const std::vector<Body> bodies = bodies_of(fitted);
  const VolumeIntegral found = integrate_union(bodies), true_one = integrate_union(truth);
  std::printf("| %s | %zu | %s | %g | %zu | %.2g | %+.2f | %.2f | %.1f |\n", name, truth.size(), name_of(family), 1e3 * sigma,
              bodies.size(), 1e3 * std::max(largest_distance(bodies, truth), largest_distance(truth, bodies)),
              100 * (found.solid.volume / true_one.solid.volume - 1), 100 * inertia_error(found.solid, true_one.solid), seconds);
  std::fflush(stdout);
}

struct TimedBody {
  Vector3 half_axes;
  double delta, epsilon, taper;
  bool is_half_missing;
};

double seconds_of(const Cloud& cloud, const FitSettings& settings) {
  const std::clock_t start = std::clock();
  fit_body(cloud, settings);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Errors of half-axes, exponents and tapers of known bodies, next to the stated standard errors.
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

/// How often the truth is within one and two standard errors.
void print_coverage(int bodies) {
  std::printf("%d bodies a row, %zu points each; %% of the numbers within one and two standard errors\n\n", bodies,
              kCoveragePoints);
  std::printf("| body | data | noise |");
  for (const Kind& kind : kKinds) std::printf(" %s |", kind.name);
  std::puts(" ? | other axes | edges below noise | their exponents |\n|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const Covered& chosen : {Covered{Family::Superellipsoid, 0.01, false}, Covered{Family::Superellipsoid, 0.05, false},
                                Covered{Family::Superellipsoid, 0.01, true}, Covered{Family::Superellipsoid, 0.05, true},
                                Covered{Family::Superovoid, 0.01, false}, Covered{Family::Superovoid, 0.05, false}}) {
    print_covered(chosen, bodies);
  }
}

/// Fits of unions of several bodies.
void print_unions() {
  std::printf("at most %d bodies, %zu points on each part, less what others cover\n\n", kLargestCount, kPointsOfPart);
  std::puts("| body | parts | fitted | noise, mm | found | Hausdorff, mm | volume, % | inertia, % | time, s |");
  std::puts("|---|---|---|---|---|---|---|---|---|");
  for (const double sigma : {0.0, 3e-4, 1e-3}) print_row("dumbbell", Family::Superellipsoid, sigma);
  for (const double sigma : {0.0, 3e-4, 1e-3}) print_row("molar", Family::Superovoid, sigma);
  print_row("molar", Family::Superellipsoid, 3e-4);
}

/// Processor time of 100 000 points.
void print_time() {
  std::puts("100 000 points, one thread; processor time, s\n");
  std::puts("| half-axes | delta, epsilon | taper | data | noise | of its family | auto |\n|---|---|---|---|---|---|---|");
  const Vector3 oblong(1.5, 1.1, 0.8), ball(1, 1, 1);
  const std::array<TimedBody, 7> cases = {{{oblong, 2, 2, 0, false},
                                           {oblong, 2.5, 4, 0, false},
                                           {oblong, 8, 6, 0, false},
                                           {oblong, 1.2, 20, 0, false},
                                           {oblong, 2.5, 4, -0.3, false},
                                           {oblong, 8, 6, 0, true},
                                           {ball, 8, 6, 0, true}}};
  for (const TimedBody& chosen : cases) {
    Body truth;
    truth.family = chosen.taper == 0 ? Family::Superellipsoid : Family::Superovoid;
    truth.half_axes = chosen.half_axes;
    truth.delta = chosen.delta;
    truth.epsilon = chosen.epsilon;
    truth.taper = chosen.taper;
    truth.position = {3, -2, 5};
    truth.orientation = Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized();
    for (const double noise : {0.0, 0.01, 0.05}) {
      const Cloud cloud = scatter(truth, {.points = 100000, .noise = noise, .is_half_missing = chosen.is_half_missing});
      FitSettings settings;
      const double of_any = seconds_of(cloud, settings);
      settings.family = truth.family;
      std::printf("| %g, %g, %g | %g, %g | %g | %s | %g %% | %.2f | %.2f |\n", truth.half_axes.x(), truth.half_axes.y(),
                  truth.half_axes.z(), truth.delta, truth.epsilon, truth.taper, chosen.is_half_missing ? "half" : "whole",
                  100 * noise, seconds_of(cloud, settings), of_any);
      std::fflush(stdout);
    }
  }
}

void write_points(const std::string& path, const std::vector<Vector3>& points) {
  std::ofstream file(path);
  file.precision(12);
  for (const Vector3& x : points) file << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

/// Writes 4000 points of each stone, and prints the kind of the stones themselves.
void write_stones(const std::string& folder, std::size_t count, double noise) {
  std::filesystem::create_directories(folder);
  std::vector<FittedBody> exact;
  std::vector<KindScan> scans;
  for (const Body& stone : make_stones(count, 1)) {
    const std::string name = "stone_" + std::to_string(scans.size() + 101) + ".xyz";
    write_points(std::string(folder).append("/").append(name),
                 scatter(stone, {.points = 4000, .noise = noise, .seed = scans.size() + 1}).points);
    exact.emplace_back().body = stone;
    KindScan scan{name, exact.back(), {}, {}};
    scan.error.radius = 1;
    scans.push_back(scan);
  }
  std::fputs(describe(find_kind(exact), scans).c_str(), stdout);
}

int run_program(int argc, char** argv) {
  CLI::App app("Fits bodies that are known.", "fit_study");
  app.require_subcommand(1);
  int bodies = 12;
  const auto add_bodies = [&](CLI::App* study) {
    study->add_option("--bodies", bodies, "bodies in a row of the table")->check(CLI::Range(1, 100000))->capture_default_str();
  };
  CLI::App* const recovery = app.add_subcommand("recovery", "errors of the numbers, whole and half bodies, with noise");
  add_bodies(recovery);
  CLI::App* const coverage = app.add_subcommand("coverage", "how often the truth lies within one and two standard errors");
  add_bodies(coverage);
  CLI::App* const unions = app.add_subcommand("unions", "the bodies of samples/compound taken apart");
  CLI::App* const time = app.add_subcommand("time", "processor time of 100 000 points");
  CLI::App* const compound = app.add_subcommand("compound", "writes points of a body of samples/compound");
  std::string name, path;
  double sigma = 0.0003;
  std::size_t each = 4000;
  compound->add_option("name", name, "dumbbell or molar")->required();
  compound->add_option("file", path, "NAME.xyz, written")->required();
  compound->add_option("--sigma", sigma, "m, noise in every direction")->check(CLI::NonNegativeNumber)->capture_default_str();
  compound->add_option("--points", each, "of each of its parts")->check(CLI::Range(100, 1000000))->capture_default_str();
  CLI::App* const stones = app.add_subcommand("stones", "writes a folder of scans of stones of one kind, and prints the kind");
  std::size_t count = 20;
  double noise = 0.01;
  stones->add_option("folder", path, "written")->required();
  stones->add_option("--scans", count, "in the folder")->check(CLI::Range(2, 10000))->capture_default_str();
  stones->add_option("--noise", noise, "relative to the mean half-axis")->check(CLI::NonNegativeNumber)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (*recovery) print_recovery(bodies);
  if (*coverage) print_coverage(bodies);
  if (*unions) print_unions();
  if (*time) print_time();
  if (*stones) write_stones(path, count, noise);
  if (*compound) write_points(path, scatter_union(make_compound(name), each, sigma, 1).points);
  return 0;
}

}  // namespace
}  // namespace fit

int main(int argc, char** argv) {
  try {
    return fit::run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fit_study: %s\n", error.what());
    return 1;
  }
}
