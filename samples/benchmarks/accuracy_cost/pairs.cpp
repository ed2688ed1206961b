#include "pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace accuracy_cost {

namespace {

using common::Random;
using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Settings;
using supernormal::Shape;
using supernormal::Vector3;

constexpr double kReferenceTolerance = 1e-14;
constexpr double kWarmDistance = 1e-3;  // m and rad
constexpr int kReferenceStarts = 60;    // per overlapping pair
constexpr int kUnused = 16;             // directions a pair; with them the pairs are those of the published tables

struct Range {
  double low, high;
};

// Of each class, and of each situation the gap over the smallest half-axis; Far has another.
constexpr std::array<Range, 6> kExponents = {{{2, 2}, {1.3, 5}, {6, 20}, {1.1, 1.3}, {2, 5}, {2, 2}}};
constexpr std::array kGaps = {-0.01, -0.3, 0.01, 0.0, 0.0};

double wanted_gap(Random& random, Situation situation, double size) {
  return situation == Situation::Far ? uniform(random, 1, 5) : kGaps[static_cast<std::size_t>(situation)] * size;
}

/// The i-th of kReferenceStarts directions, uniformly spread on a golden-angle spiral.
Vector3 spiral_direction(int i) {
  const double z = 1 - (2 * i + 1.0) / kReferenceStarts;
  const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

Pair draw_pair(Random& random, BodyClass body_class, Situation situation) {
  Pair pair{body_class, situation, random_body(random, body_class), random_body(random, body_class), {}, {}, 0, 0, {}, {}, {}};
  pair.size = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
  pair.pose1.rotation = random_orientation(random);
  pair.pose2.rotation = random_orientation(random);
  const Vector3 n = random_normal(random);
  const Vector3 reach1 = pair.pose1.rotation * pair.shape1->point(pair.pose1.rotation.transpose() * n);
  const Vector3 reach2 = pair.pose2.rotation * pair.shape2->point(-(pair.pose2.rotation.transpose() * n));
  pair.pose2.position = reach1 - reach2 + wanted_gap(random, situation, pair.size) * n;

  Settings exact;
  exact.tolerance = kReferenceTolerance;
  const auto answer = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, exact);
  pair.gap = answer.gap;
  pair.normal = answer.normal;
  pair.contact = answer.contact;
  improve_reference(pair, n);
  if (pair.gap < 0) {  // there may be several maxima
    for (int i = 0; i < kReferenceStarts; ++i) improve_reference(pair, spiral_direction(i));
  }

  Pose earlier = pair.pose2;
  earlier.position += kWarmDistance * random_normal(random);
  earlier.rotation = Eigen::AngleAxisd(kWarmDistance, random_normal(random)).toRotationMatrix() * earlier.rotation;
  const Matrix3 to_body1 = pair.pose1.rotation.transpose();
  pair.warm_normal = to_body1 * find_proximity(*pair.shape1, pair.pose1, *pair.shape2, earlier, exact).normal;
  for (int k = 0; k < kUnused; ++k) random_normal(random);
  return pair;
}

}  // namespace

using common::Random;
using supernormal::Matrix3;
using supernormal::Vector3;

double uniform(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

Vector3 random_normal(Random& random) {
  const double z = uniform(random, -1, 1);
  const double angle = 2 * std::numbers::pi * random.uniform();
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

Matrix3 random_orientation(Random& random) {
  const auto [w, x, y, z] = random.rotation();
  return Eigen::Quaterniond(w, x, y, z).toRotationMatrix();
}

std::shared_ptr<const Shape> random_body(Random& random, BodyClass body_class) {
  const double a = uniform(random, 0.5, 1.5);
  const double b = uniform(random, 0.5, 1.5);
  const double c = uniform(random, 0.5, 1.5);
  if (body_class == BodyClass::Sphere) return std::make_shared<supernormal::Ellipsoid>(Vector3::Constant(a));
  if (body_class == BodyClass::Ellipsoid) return std::make_shared<supernormal::Ellipsoid>(Vector3(a, b, c));
  const Range& range = kExponents[static_cast<std::size_t>(body_class)];
  const double delta = uniform(random, range.low, range.high);
  const double epsilon = uniform(random, range.low, range.high);
  const double thin = body_class == BodyClass::Needle ? 0.1 : 1;
  return std::make_shared<supernormal::Superellipsoid>(Vector3(thin * a, thin * b, c), delta, epsilon);
}

char letter(BodyClass body_class) { return "EMBONP"[static_cast<int>(body_class)]; }

char letter(Situation situation) { return "SDNFT"[static_cast<int>(situation)]; }

std::vector<Pair> draw_pairs_of(BodyClass body_class, Situation situation, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Pair> pairs;
  pairs.reserve(count);
  for (std::size_t i = 0; i < count; ++i) pairs.push_back(draw_pair(random, body_class, situation));
  return pairs;
}

void improve_reference(Pair& pair, const Vector3& world_normal) {
  Settings exact;
  exact.tolerance = kReferenceTolerance;
  const Vector3 start = (pair.pose1.rotation.transpose() * world_normal).normalized();
  const auto answer = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, exact, &start);
  if (!(answer.gap > pair.gap)) return;
  pair.gap = answer.gap;
  pair.normal = answer.normal;
  pair.contact = answer.contact;
}

}  // namespace accuracy_cost
