// Tests of the methods of the literature on published cases, so that the comparison is fair.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "literature/method.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

using namespace literature;
using supernormal::Ellipsoid;
using supernormal::Pose;
using supernormal::Proximity;
using supernormal::Superellipsoid;

namespace {

// The random pairs of Goncalves, Bernardino, Jorge and Lopes (2017), drawn as by the generator of their program.

struct RandomPair {
  Superellipsoid shape1, shape2;
  Pose pose1, pose2;
};

/// The linear congruential generator of the C standard's example, with 32 bits of state, of which the upper 15 count. Numbers are
/// rounded to single precision, as in their program.
class Generator {
 public:
  /// A multiple of 1/1024 of the range, m or without unit.
  double in_range(double low, double high) { return float_of(low + number() % 1024 / 1024.0 * (high - low)); }

  /// A quaternion of four sums of 16 uniform numbers each, which are almost normally distributed.
  Matrix3 rotation() {
    std::array<double, 4> q{};
    for (double& part : q) {
      double sum = 0;
      for (int k = 0; k < 16; ++k) sum += number() % 10240 / 10240.0;
      part = float_of(sum / 16 - 0.5);
    }
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }

  /// Half-axes 0.5...1.5, exponents 2/1.1...2/0.3. Two more numbers are the tapers, which are 0 here.
  Superellipsoid superellipsoid() {
    Vector3 half_axes;
    for (double& half_axis : half_axes) half_axis = in_range(0.5, 1.5);
    const double delta = 2 / in_range(0.3, 1.1);
    const double epsilon = 2 / in_range(0.3, 1.1);
    for (int k = 0; k < 2; ++k) in_range(-0.4, 0.4);
    return {half_axes, delta, epsilon};
  }

 private:
  static double float_of(double x) { return static_cast<double>(static_cast<float>(x)); }
  int number() {
    state_ = 1103515245U * state_ + 12345U;
    return static_cast<int>((state_ >> 16U) & 0x7fffU);
  }

  std::uint32_t state_ = 1337;
};

/// The first pairs; the centres are 4 m apart.
std::vector<RandomPair> goncalves_pairs(int count) {
  Generator generator;
  std::vector<RandomPair> pairs;
  for (int i = 0; i < count; ++i) {
    const Superellipsoid shape1 = generator.superellipsoid(), shape2 = generator.superellipsoid();
    const Matrix3 rotation1 = generator.rotation(), rotation2 = generator.rotation();
    pairs.push_back({shape1, shape2, {Vector3::Zero(), rotation1}, {Vector3(4, 0, 0), rotation2}});
  }
  return pairs;
}

constexpr double kTolerance = 1e-8;  // the finest class of Goncalves et al.

Proximity certified(const RandomPair& pair) {
  supernormal::Settings settings;
  settings.tolerance = 1e-14;
  return find_proximity(pair.shape1, pair.pose1, pair.shape2, pair.pose2, settings);
}

Pose at(const Vector3& position, const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity()) {
  return {position, orientation.toRotationMatrix()};
}

const Eigen::Quaterniond kHalfTurnAboutX(0, 1, 0, 0);

bool knows_distances(const NamedMethod& method) { return std::string(method.name) != "midway point (3)"; }

void check_gap(const NamedMethod& method, const Bodies& bodies, double gap, double tolerance) {
  const CommonNormal found = method.solve(bodies, {.tolerance = kTolerance});
  INFO(std::string(method.name));
  REQUIRE(found.outcome == Outcome::Found);
  CHECK(std::abs(found.gap - gap) <= tolerance);
}

}  // namespace

TEST_CASE("the first 100 pairs of Goncalves et al. have the published sum of distances") {
  double sum = 0;
  for (const RandomPair& pair : goncalves_pairs(100)) sum += certified(pair).gap;
  CHECK(std::abs(sum - 175.0763787139) <= 1e-10);
}

TEST_CASE("the 1000 pairs of Goncalves et al. are solved with few failures and no wrong answer") {
  // The largest number of failures of 1000, from a cold start and with the normal of a pose a millimetre away.
  struct Most {
    int cold, warm;
  };
  const std::map<std::string, Most> most = {{"implicit points (1)", {1, 0}},
                                            {"surface angles (2)", {45, 1}},
                                            {"normal angles (2)", {4, 2}},
                                            {"midway point (3)", {0, 0}},
                                            {"contact space: fixed point (4)", {36, 18}},
                                            {"contact space: distance (4)", {6, 2}},
                                            {"contact space: common normal (4)", {3, 1}}};
  std::map<std::string, Most> failed;
  for (const RandomPair& pair : goncalves_pairs(1000)) {
    const double gap = certified(pair).gap;
    RandomPair earlier = pair;
    earlier.pose2.position += Vector3::Constant(1e-3);
    const Vector3 first_normal = pair.pose1.rotation.transpose() * certified(earlier).normal;
    const Bodies bodies(pair.shape1, pair.pose1, pair.shape2, pair.pose2);
    for (const NamedMethod& method : methods()) {
      for (const bool is_warm : {false, true}) {
        const CommonNormal found =
            method.solve(bodies, {.tolerance = kTolerance, .first_normal = is_warm ? &first_normal : nullptr});
        INFO(std::string(method.name), is_warm ? ", warm" : ", cold");
        if (found.outcome == Outcome::Failed) ++(is_warm ? failed[method.name].warm : failed[method.name].cold);
        if (found.outcome == Outcome::Apart) CHECK(!knows_distances(method));
        if (found.outcome == Outcome::Found) CHECK(std::abs(found.gap - gap) <= 1e-6);
      }
    }
  }
  for (const NamedMethod& method : methods()) {
    INFO(std::string(method.name));
    CHECK(failed[method.name].cold <= most.at(method.name).cold);
    CHECK(failed[method.name].warm <= most.at(method.name).warm);
  }
}

TEST_CASE("the methods of the literature find the gaps of R1 and R2 of the contact-space demos") {
  const Superellipsoid first(Vector3(15, 10, 5), 2 / 0.7, 2 / 0.5), second(Vector3(5, 3, 2), 2 / 0.2, 2 / 1.25);
  const Bodies apart(first, at({2.82, -16.4, 7.52}, kHalfTurnAboutX), second, at({-0.47, 8.44, 0.8}, kHalfTurnAboutX));
  const Ellipsoid large(Vector3(20, 15, 10)), small(Vector3(15, 12, 8));
  const Bodies overlapping(large, at({-10, 7.25, 3.56}, kHalfTurnAboutX), small, at({15.3, -2.2, 2.84}, kHalfTurnAboutX));
  for (const NamedMethod& method : methods()) {
    if (!knows_distances(method)) continue;
    check_gap(method, apart, 12.6945142566438972, 1e-7);
    check_gap(method, overlapping, -6.3690451349138511, 1e-7);
  }
}

TEST_CASE("for L1 and L2 of the LAMMPS unit tests the midway point is the point of touch, with the right overlap") {
  constexpr double kRadius = 3.456;
  for (int halves = 4; halves <= 20; ++halves) {
    const double exponent = 0.5 * halves;
    const Superellipsoid small(Vector3::Constant(kRadius), exponent, exponent);
    const Superellipsoid large(Vector3::Constant(2 * kRadius), exponent, exponent);
    const Bodies overlapping(small, at({-0.95 * kRadius, 0, 0}), large, at({1.95 * kRadius, 0, 0}));
    for (const NamedMethod& method : methods()) {
      if (!knows_distances(method)) check_gap(method, overlapping, -0.1 * kRadius, 1e-9);
    }
    const Bodies touching(small, at({-kRadius, 0, 0}), small, at({kRadius * (1 - 1e-9), 0, 0}));
    for (const NamedMethod& method : methods()) {
      if (!knows_distances(method)) check_gap(method, touching, -1e-9 * kRadius, 1e-12);
    }
  }
}

TEST_CASE("a recorded path of the literature's methods ends at the answer and does not change it") {
  const RandomPair pair = goncalves_pairs(1).front();
  const Bodies bodies(pair.shape1, pair.pose1, pair.shape2, pair.pose2);
  for (const NamedMethod& method : methods()) {
    INFO(std::string(method.name));
    std::vector<Vector3> path;
    const CommonNormal plain = method.solve(bodies, {.tolerance = kTolerance});
    const CommonNormal watched = method.solve(bodies, {.tolerance = kTolerance, .path = &path});
    CHECK(watched.gap == plain.gap);
    CHECK(watched.evaluations == plain.evaluations);
    REQUIRE(!path.empty());
    CHECK((path.back() - watched.normal).norm() <= 1e-6);
  }
}

TEST_CASE("the methods of the literature refuse a shape that is not a superellipsoid") {
  struct Unknown : supernormal::Shape {
    void evaluate(const Vector3& n, supernormal::Order /*order*/, supernormal::Jet& jet) const override { jet.r = n; }
  };
  CHECK_THROWS_AS(Bodies(Unknown(), Pose(), Ellipsoid(Vector3::Ones()), Pose()), std::invalid_argument);
}
