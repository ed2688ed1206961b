#include "compounds.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <supernormal/proximity/solve.hpp>

#include "model/distance.hpp"
#include "truth.hpp"

namespace fit {
namespace {

Body make_part(Family family, const Vector3& half_axes, double delta, double epsilon, double taper, const Vector3& position,
               double angle) {
  Body body{family, position, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3::UnitX())), half_axes, delta, epsilon, taper};
  return body;
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

}  // namespace fit
