#include "bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <supernormal/proximity/solve.hpp>

#include "kind/grain_kind.hpp"
#include "model/distance.hpp"
#include "truth.hpp"

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

}  // namespace fit
