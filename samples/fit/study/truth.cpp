#include "truth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <supernormal/proximity/solve.hpp>

#include "input/sampling.hpp"
#include "kind/grain_kind.hpp"
#include "model/distance.hpp"

namespace fit {

namespace {

Body make_part(Family family, const Vector3& half_axes, double delta, double epsilon, double taper, const Vector3& position,
               double angle) {
  return {family, position, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3::UnitX())), half_axes, delta, epsilon, taper};
}

std::vector<Body> make_dumbbell() {
  constexpr double kBar = 0.08, kDisc = 0.03;
  const auto disc = [&](double z) { return make_part(Family::Superellipsoid, {0.06, 0.06, kDisc}, 2, 6, 0, {0, 0, z}, 0); };
  return {make_part(Family::Superellipsoid, {0.014, 0.014, kBar}, 2, 8, 0, Vector3::Zero(), 0), disc(kBar + kDisc),
          disc(-kBar - kDisc)};
}

std::vector<Body> make_molar() {
  constexpr double kCrown = 0.035, kRoot = 0.06, kSpread = 0.12;
  std::vector<Body> parts = {make_part(Family::Superovoid, {0.055, 0.05, kCrown}, 3.5, 4, 0.15, Vector3::Zero(), 0)};
  for (const double side : {1.0, -1.0}) {
    Body root =
        make_part(Family::Superovoid, {0.02, 0.016, kRoot}, 2, 3, 0.5, {0, side * 0.028, -kCrown - 1.05 * kRoot}, side * kSpread);
    for (int i = 0; i < 50; ++i) {  // raised until it touches the crown
      const auto gap = supernormal::find_proximity(*make_shape(root), root.pose(), *make_shape(parts[0]), parts[0].pose());
      root.position.z() += gap.gap / std::abs(gap.normal.z());
      if (std::abs(gap.gap) < 1e-14) break;
    }
    parts.push_back(root);
  }
  return parts;
}

}  // namespace

Body random_superellipsoid(std::mt19937_64& random) {
  const auto exponent = [&] { return 1 + std::exp(std::log(0.3) + std::log(7 / 0.3) * uniform(random)); };
  const double a = 1.2 + 0.4 * uniform(random), b = 0.8 + 0.3 * uniform(random), c = 0.4 + 0.3 * uniform(random);
  const std::array<Vector3, 3> orders = {Vector3(a, b, c), Vector3(c, a, b), Vector3(b, c, a)};
  Body body;
  body.family = Family::Superellipsoid;
  body.position = {3, -2, 5};
  body.half_axes = orders[random() % orders.size()];
  body.delta = exponent();
  body.epsilon = exponent();
  const double w = uniform(random) - 0.5, x = uniform(random) - 0.5, y = uniform(random) - 0.5, z = uniform(random) - 0.5;
  body.orientation = Eigen::Quaterniond(w, x, y, z).normalized();
  return body;
}

Body random_superovoid(std::mt19937_64& random, double share) {
  Body body = random_superellipsoid(random);
  body.family = Family::Superovoid;
  body.taper = (random() % 2 == 0 ? share : -share) * taper_limit(body.epsilon);
  return body;
}

std::vector<Body> make_compound(const std::string& name) {
  if (name == "dumbbell") return make_dumbbell();
  if (name == "molar") return make_molar();
  throw std::invalid_argument("compound \"" + name + "\"; allowed: dumbbell, molar");
}

Cloud scatter_union(const std::vector<Body>& bodies, std::size_t count, double sigma, std::uint64_t seed) {
  Cloud cloud;
  for (const Body& body : bodies) {
    // Both draws use the same seed: the points without noise show which points are covered.
    Scatter settings{.points = count, .seed = ++seed};
    const Cloud exact = scatter(body, settings);
    settings.noise = sigma / mean_half_axis(body);
    const Cloud noisy = scatter(body, settings);
    for (std::size_t i = 0; i < exact.points.size(); ++i) {
      const bool is_covered = std::ranges::any_of(
          bodies, [&](const Body& other) { return &other != &body && DistanceFunction(other).contains(exact.points[i]); });
      if (!is_covered) cloud.points.push_back(noisy.points[i]);
    }
  }
  return cloud;
}

std::vector<Body> make_stones(std::size_t count, std::uint64_t seed) {
  NormalNumbers normal(seed);
  std::mt19937_64 random(seed);
  std::vector<Body> stones;
  for (std::size_t i = 0; i < count; ++i) {
    Body stone = random_superellipsoid(random);
    const double b = normal(), c = normal(), delta = normal(), epsilon = normal(), size = normal();
    stone.half_axes = {1, 0.8 + 0.05 * b, 0.6 + 0.04 * c};
    stone.delta = 1 + 1.4 * std::exp(0.1 * delta);
    stone.epsilon = 1 + 1.8 * std::exp(0.1 * epsilon);
    stone.half_axes *= 0.01 * std::pow(1.25, size) / size_of(stone);
    stones.push_back(stone);
  }
  return stones;
}

double NormalNumbers::operator()() {
  const double u = 1 - uniform(random_), v = uniform(random_);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

double mean_half_axis(const Body& body) { return std::cbrt(body.half_axes.prod()); }

Cloud scatter(const Body& truth, const Scatter& settings) {
  const std::size_t wanted = settings.points;
  // About half of the points are removed: sample slightly more than twice as many.
  const std::size_t made = settings.is_half_missing ? 2 * wanted + wanted / 2 + 50 : wanted;
  const Cloud surface = sample_boundary(*make_shape(truth), made, settings.seed);
  NormalNumbers normal(settings.seed + 1000);
  const double sigma = settings.noise * mean_half_axis(truth);
  const Matrix3 R = truth.rotation();
  const Vector3 side = Vector3(1, 0.6, -0.5).cwiseQuotient(truth.half_axes);
  Cloud cloud;
  for (std::size_t i = 0; i < surface.points.size() && cloud.points.size() < wanted; ++i) {
    if (settings.is_half_missing && side.dot(surface.points[i]) < 0) continue;
    const double x = normal(), y = normal(), z = normal();
    cloud.points.emplace_back(truth.position + R * surface.points[i] + sigma * Vector3(x, y, z));
    if (settings.has_normals) cloud.normals.emplace_back(R * surface.normals[i]);
  }
  return cloud;
}

Body aligned(const Body& fitted, const Body& truth, Eigen::Matrix3d& axes) {
  const bool z_is_free = truth.delta == truth.epsilon && truth.taper == 0;
  constexpr std::array<std::array<int, 3>, 6> kPermutations = {{{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}};
  double largest = -4;
  axes.setIdentity();
  for (const auto& permutation : kPermutations) {
    if (permutation[2] != 2 && !z_is_free) continue;
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3 candidate = Matrix3::Zero();
      for (int k = 0; k < 3; ++k) candidate(permutation[static_cast<std::size_t>(k)], k) = ((signs >> k) & 1) != 0 ? -1 : 1;
      if (candidate.determinant() < 0) continue;
      const double trace = (truth.rotation().transpose() * fitted.rotation() * candidate).trace();
      if (trace <= largest) continue;
      largest = trace;
      axes = candidate;
    }
  }
  Body result = fitted;
  result.orientation = Eigen::Quaterniond(fitted.rotation() * axes).normalized();
  result.half_axes = axes.cwiseAbs().transpose() * fitted.half_axes;
  if (axes(2, 2) < 0) result.taper = -fitted.taper;
  return result;
}

Eigen::Matrix<double, kParameters, 1> deviation(const Body& fitted, const Body& truth) {
  Eigen::Matrix<double, kParameters, 1> result;
  result.segment<3>(kPosition) = fitted.position - truth.position;
  const Eigen::AngleAxisd turn(truth.rotation().transpose() * fitted.rotation());
  result.segment<3>(kRotation) = turn.angle() * turn.axis();
  result.segment<3>(kLogAxes) = fitted.half_axes - truth.half_axes;
  result[kLogDelta] = fitted.delta - truth.delta;
  result[kLogEpsilon] = fitted.epsilon - truth.epsilon;
  result[kTaper] = fitted.taper - truth.taper;
  return result;
}

Compared compare(const FittedBody& fitted, const Body& truth) {
  Compared result;
  Eigen::Matrix3d axes;
  result.body = aligned(fitted.body, truth, axes);
  result.deviation = deviation(result.body, truth);
  result.standard_error = fitted.uncertainty.standard_error;
  result.is_determined = fitted.uncertainty.is_determined;
  result.is_edge_below_noise = fitted.is_edge_below_noise;
  const Eigen::Matrix3d from = axes.cwiseAbs().transpose();
  for (const int first : {kRotation, kLogAxes}) {
    result.standard_error.segment<3>(first) = from * fitted.uncertainty.standard_error.segment<3>(first);
    for (int i = first; i < first + 3; ++i) {
      Eigen::Index source = 0;
      from.row(i - first).maxCoeff(&source);
      result.is_determined[static_cast<std::size_t>(i)] =
          fitted.uncertainty.is_determined[static_cast<std::size_t>(first + source)];
    }
  }
  constexpr double kOtherAxes = 0.6;  // rad; 45 degrees are 0.79
  for (int i = kRotation; i < kRotation + 3; ++i) {
    const bool counts = result.is_determined[static_cast<std::size_t>(i)];
    if (counts && std::abs(result.deviation[i]) > kOtherAxes) result.has_other_axes = true;
  }
  return result;
}

Compared fit_and_compare(const Body& truth, const Scatter& scatter_settings) {
  FitSettings settings;
  settings.family = truth.family;
  return compare(fit_body(scatter(truth, scatter_settings), settings), truth);
}

}  // namespace fit
