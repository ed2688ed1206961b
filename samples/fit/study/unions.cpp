#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "compounds.hpp"
#include "model/distance.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
#include "studies.hpp"

namespace fit {
namespace {

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
  std::vector<Body> bodies(fitted.size());
  std::ranges::transform(fitted, bodies.begin(), &FittedBody::body);
  const VolumeIntegral found = integrate_union(bodies), true_one = integrate_union(truth);
  std::printf("| %s | %zu | %s | %g | %zu | %.2g | %+.2f | %.2f | %.1f |\n", name, truth.size(), name_of(family), 1e3 * sigma,
              bodies.size(), 1e3 * std::max(largest_distance(bodies, truth), largest_distance(truth, bodies)),
              100 * (found.solid.volume / true_one.solid.volume - 1), 100 * inertia_error(found.solid, true_one.solid), seconds);
  std::fflush(stdout);
}

}  // namespace

void print_unions() {
  std::printf("at most %d bodies, %zu points on each part, less what others cover\n\n", kLargestCount, kPointsOfPart);
  std::puts("| body | parts | fitted | noise, mm | found | Hausdorff, mm | volume, % | inertia, % | time, s |");
  std::puts("|---|---|---|---|---|---|---|---|---|");
  for (const double sigma : {0.0, 3e-4, 1e-3}) print_row("dumbbell", Family::Superellipsoid, sigma);
  for (const double sigma : {0.0, 3e-4, 1e-3}) print_row("molar", Family::Superovoid, sigma);
  print_row("molar", Family::Superellipsoid, 3e-4);
}

}  // namespace fit
