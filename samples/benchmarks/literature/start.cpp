#include "start.hpp"

#include <limits>
#include <numbers>

namespace literature {
namespace {

constexpr int kLevels = 6;

constexpr std::array<std::array<double, 2>, 4> kQuarters = {{{-0.5, -0.5}, {-0.5, 0.5}, {0.5, -0.5}, {0.5, 0.5}}};

Vector2 middle(const Vector2& angles, const Vector2& reach, std::size_t quarter) {
  return angles + reach.cwiseProduct(Vector2(kQuarters[quarter][0], kQuarters[quarter][1]));
}

std::array<Vector2, 2> angles_of(const Bodies& bodies, const Vector3& normal) {
  return {bodies.body1.angles_of(normal), bodies.body2.angles_of(-(bodies.rotation.transpose() * normal))};
}

/// Quarters the angles of both surfaces six times. Keeps the pair of quarters whose centres are nearest.
std::array<Vector2, 2> quadtree(const Bodies& bodies, int& evaluations) {
  std::array<Vector2, 2> best = {Vector2::Zero(), Vector2::Zero()};
  Vector2 reach(std::numbers::pi / 2, std::numbers::pi);
  for (int level = 0; level < kLevels; ++level) {
    std::array<Vector3, 4> points1, points2;
    for (std::size_t k = 0; k < kQuarters.size(); ++k) {
      points1[k] = bodies.body1.point(middle(best[0], reach, k));
      points2[k] = bodies.rotation * bodies.body2.point(middle(best[1], reach, k)) + bodies.offset;
    }
    evaluations += static_cast<int>(kQuarters.size());
    double least = std::numeric_limits<double>::infinity();
    std::array<std::size_t, 2> nearest = {0, 0};
    for (std::size_t i = 0; i < kQuarters.size(); ++i) {
      for (std::size_t j = 0; j < kQuarters.size(); ++j) {
        const double squared = (points1[i] - points2[j]).squaredNorm();
        if (squared >= least) continue;
        least = squared;
        nearest = {i, j};
      }
    }
    best = {middle(best[0], reach, nearest[0]), middle(best[1], reach, nearest[1])};
    reach /= 2;
  }
  return best;
}

}  // namespace

std::array<Vector2, 2> start_angles(const Bodies& bodies, const Options& options, Start start, int& evaluations) {
  if (options.first_normal == nullptr && start == Start::Quadtree) return quadtree(bodies, evaluations);
  ++evaluations;
  if (options.first_normal != nullptr) return angles_of(bodies, *options.first_normal);
  const double distance = bodies.offset.norm();
  return angles_of(bodies, distance > 0 ? Vector3(bodies.offset / distance) : Vector3::UnitX());
}

}  // namespace literature
