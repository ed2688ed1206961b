// Tests of pairs with known answers: published inputs or closed forms (tests/data/README.md) to 1e-10 of the bodies' size, and the
// pairs of tests/data/known_pairs.txt, which a search has missed: every answer covers what is known of the pair.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "proximity/covers.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/hard_cases/body.hpp"
#include "support/reference_pairs.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;
using samples::Body;

namespace {

Settings fine() { return {.tolerance = 1e-12}; }

Pose at(const Vector3& position, const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity()) {
  return {position, orientation.toRotationMatrix()};
}

Superellipsoid superball(double radius, double exponent) { return {Vector3::Constant(radius), exponent, exponent}; }

/// Compares with vectors that are given to 13 decimals.
void check_near(const Vector3& value, const Vector3& expected, double tolerance) {
  CHECK_MESSAGE((value - expected).norm() <= tolerance, text(value), " instead of ", text(expected));
}

const Eigen::Quaterniond kHalfTurnAboutX(0, 1, 0, 0);

struct KnownPair {
  std::string name;
  std::vector<Body> bodies;
  Pose pose2;
  Settings settings;
  std::optional<Vector3> first_normal;
};

/// The body of a line of the file; x: its parameters.
Body body_of(const std::string& name, const std::vector<double>& x) {
  if (name == "capsule") return samples::capsule(x[0], x[1]);
  if (name == "cylinder") return samples::cylinder(x[0], x[1]);
  std::vector<Vector3> points;
  for (std::size_t k = 0; k + 3 <= x.size(); k += 3) points.emplace_back(x[k], x[k + 1], x[k + 2]);
  if (name == "polytope") return samples::polytope(points);
  if (name == "box") return samples::box(points[0]);
  if (name == "superovoid") return samples::superovoid(points[0], x[3], x[4], x[5], x[6]);
  REQUIRE(name == "superellipsoid");
  return samples::superellipsoid(points[0], x[3], x[4]);
}

/// x: the numbers of the fact.
void check(const KnownPair& pair, const std::string& fact, const std::vector<double>& x) {
  CAPTURE(pair.name);
  const auto shape1 = samples::make_shape(pair.bodies[0]), shape2 = samples::make_shape(pair.bodies[1]);
  const Vector3* const first = pair.first_normal ? &*pair.first_normal : nullptr;
  const Proximity answer = find_proximity(*shape1, {}, *shape2, pair.pose2, pair.settings, first);
  if (fact == "higher") {
    CHECK(test::gap_at(*shape1, {}, *shape2, pair.pose2, {x[0], x[1], x[2]}) <= answer.gap + answer.global_error);
    if (!test::must_be_proved(GapFunction(*shape1, {}, *shape2, pair.pose2), pair.settings, answer.gap)) return;
  } else if (fact == "placed") {
    CHECK(x[0] <= answer.gap + answer.error + 1e-15);
  } else if (fact == "gap") {
    CHECK(std::abs(answer.gap - x[0]) <= x[1]);
  } else if (fact == "touching") {
    CHECK(std::abs(answer.gap) <= answer.error);
    CHECK(answer.error <= 1e-9);
  } else {
    REQUIRE(fact == "apart");
    CHECK(answer.gap > 0);
  }
  CHECK(answer.status == Status::Converged);
  CHECK(answer.is_global);
}

}  // namespace

TEST_CASE("R1: superellipsoids of the closed-form contact space demos, apart") {
  const Superellipsoid shape1(Vector3(15, 10, 5), 2 / 0.7, 2 / 0.5), shape2(Vector3(5, 3, 2), 2 / 0.2, 2 / 1.25);
  const Proximity out =
      find_proximity(shape1, at({2.82, -16.4, 7.52}, kHalfTurnAboutX), shape2, at({-0.47, 8.44, 0.8}, kHalfTurnAboutX), fine());
  CHECK(out.status == Status::Converged);
  CHECK(std::abs(out.gap - 12.6945142566438972) <= 1e-10 * out.gap);
  // A gap exact to e fixes the normal to sqrt(2 e / (H1 + H2 + s)), here 1e-6 for e = 1e-11.
  check_near(out.normal, Vector3(-0.0018948754308, 0.9516017981184, -0.3073278823422), 1e-6);
  check_near(out.point1, Vector3(2.1781654632855, -6.6089213379082, 4.8540806508774), 1e-5);
  check_near(out.point2, Vector3(2.1541109401146, 5.4712012549538, 0.9527024670205), 1e-5);
}

TEST_CASE("R2: ellipsoids of the closed-form contact space demos, overlapping") {
  const Ellipsoid shape1(Vector3(20, 15, 10)), shape2(Vector3(15, 12, 8));
  const Proximity out =
      find_proximity(shape1, at({-10, 7.25, 3.56}, kHalfTurnAboutX), shape2, at({15.3, -2.2, 2.84}, kHalfTurnAboutX), fine());
  CHECK(out.status == Status::Converged);
  CHECK(std::abs(out.gap - -6.3690451349138511) <= 1e-10 * 6.369);
}

TEST_CASE("L1: equal superballs of the LAMMPS unit tests touch at the origin") {
  constexpr double kRadius = 3.456;
  for (int halves = 4; halves <= 16; ++halves) {
    const double exponent = 0.5 * halves;
    const Superellipsoid shape = superball(kRadius, exponent);
    const Proximity out = find_proximity(shape, at({-kRadius, 0, 0}), shape, at({kRadius, 0, 0}), fine());
    CHECK(out.status == Status::Converged);
    CHECK(std::abs(out.gap) <= 1e-10 * kRadius);
    check_near(out.normal, Vector3::UnitX(), 1e-10);
    check_near(out.contact, Vector3::Zero(), 1e-10 * kRadius);
  }
}

TEST_CASE("L2: superballs of the LAMMPS unit tests overlap by a tenth of the radius") {
  constexpr double kRadius = 3.456;
  for (int halves = 4; halves <= 20; ++halves) {
    const double exponent = 0.5 * halves;
    const Proximity out = find_proximity(superball(kRadius, exponent), at({-0.95 * kRadius, 0, 0}),
                                         superball(2 * kRadius, exponent), at({1.95 * kRadius, 0, 0}), fine());
    CHECK(out.status == Status::Converged);
    CHECK(std::abs(out.gap - -0.3456) <= 1e-10 * 0.3456);
    check_near(out.normal, Vector3::UnitX(), 1e-10);
  }
}

TEST_CASE("concentric, identical, aligned bodies: twice the smallest half-axis") {
  for (const Superellipsoid& shape : superellipsoids(2, 200)) {
    for (const Eigen::Quaterniond& orientation :
         {Eigen::Quaterniond::Identity(), Eigen::Quaterniond(0.8, 0.1, -0.3, 0.5).normalized()}) {
      const Pose pose = at({1, 2, 3}, orientation);
      const Proximity out = find_proximity(*make_shape(shape), pose, *make_shape(shape), pose, fine());
      const double depth = 2 * shape.half_axes().minCoeff();
      const bool good = out.status == Status::Converged && std::abs(out.gap + depth) <= 1e-10 * depth;
      if (!good) FAIL_CHECK(text(shape), " gap ", out.gap, " instead of ", -depth, " status ", static_cast<int>(out.status));
    }
  }
}

TEST_CASE("concentric, identical, aligned superballs below exponent 2 separate through a face") {
  constexpr double kRadius = 0.7;
  for (const double exponent : {1.02, 1.1, 1.3, 1.5, 1.8, 1.95}) {
    const Proximity out = find_proximity(superball(kRadius, exponent), {}, superball(kRadius, exponent), {}, fine());
    const double depth = 2 * kRadius * std::pow(3, 0.5 - 1 / exponent);
    const bool good = out.status == Status::Converged && std::abs(out.gap + depth) <= 1e-10 * depth;
    if (!good)
      FAIL_CHECK("exponent ", exponent, " gap ", out.gap, " instead of ", -depth, " status ", static_cast<int>(out.status));
  }
}

TEST_CASE("homothetic aligned bodies touch where their common boundary says so") {
  const Settings settings{.tolerance = 1e-10};
  constexpr double kScale1 = 0.3, kScale2 = 1.1;
  for (const Superellipsoid& shape : superellipsoids(1.02, 200)) {
    const Superellipsoid shape1(kScale1 * shape.half_axes(), shape.delta(), shape.epsilon());
    const Superellipsoid shape2(kScale2 * shape.half_axes(), shape.delta(), shape.epsilon());
    for (const Vector3& direction : random_normals(5, 21)) {
      const Vector3 offset = direction * ((kScale1 + kScale2) / gauge(shape, direction));
      const Proximity out = find_proximity(*make_shape(shape1), {}, *make_shape(shape2), at(offset), settings);
      const double rounding = 1e-14 * (offset.norm() + shape2.half_axes().maxCoeff());
      const bool good = out.status == Status::Converged && std::abs(out.gap) <= 1e-10 * shape1.half_axes().minCoeff() + rounding;
      if (!good) FAIL_CHECK(text(shape), " towards ", text(direction), " gap ", out.gap, " status ", static_cast<int>(out.status));
    }
  }
}

// The boundary points of two faces are known to no digit, so that one evaluation proves nothing; three or four do, where the faces
// are level to rounding all the way to the middle of what they have in common.
TEST_CASE("bricks that lie on one another, beside one another's middle: the same pose again takes some four evaluations") {
  int evaluations = 0, queries = 0;
  for (const double exponent : {40.0, 60.0, 200.0}) {
    const Superellipsoid brick(Vector3(0.5, 0.4, 0.3), exponent, exponent);
    for (const double gap : {1e-6, 0.0, -1e-6, -1e-4}) {
      for (const Vector3& normal : random_normals(100, 22)) {
        const Eigen::Quaterniond orientation(Eigen::AngleAxisd(1e-5 * normal.x(), normal));
        const Pose above = at({0.45 * normal.x(), 0.35 * normal.y(), 0.6 + gap}, orientation);
        const Proximity first = find_proximity(brick, {}, brick, above);
        const Proximity again = find_proximity(brick, {}, brick, above, {}, &first.normal);
        CHECK(again.status == Status::Converged);
        CHECK(again.is_global);
        CHECK(std::abs(again.gap - first.gap) <= first.error + again.error);
        evaluations += again.evaluations;
        ++queries;
      }
    }
  }
  const double mean = 1.0 * evaluations / queries;
  MESSAGE(mean, " evaluations on average");
  CHECK(mean <= 4.5);
}

TEST_CASE("bricks that lie on one another and have moved a little: few evaluations from their last normal") {
  const Superellipsoid brick(Vector3(0.5, 0.4, 0.3), 60, 60);
  // A hundredth of the half-height deep, no ball that rolls in the bricks proves an answer.
  constexpr double kDepth = 3e-3;
  const auto mean_evaluations = [&](double beside) {
    int evaluations = 0, queries = 0;
    for (const Vector3& normal : random_normals(50, 23)) {
      Pose above = at({beside, 0, 0.6 - kDepth}, Eigen::Quaterniond(Eigen::AngleAxisd(1e-3 * normal.x(), normal)));
      Proximity found = find_proximity(brick, {}, brick, above);
      for (const Vector3& way : random_normals(10, 24)) {
        above.position += 1e-2 * kDepth * way;
        const Vector3 last = found.normal;
        found = find_proximity(brick, {}, brick, above, {}, &last);
        CHECK(found.status == Status::Converged);
        evaluations += found.evaluations;
        ++queries;
      }
    }
    return 1.0 * evaluations / queries;
  };
  const double face_on_face = mean_evaluations(0), bond = mean_evaluations(0.5);
  MESSAGE(face_on_face, " evaluations face on face, ", bond, " half beside one another");
  CHECK(face_on_face <= 2.3);
  CHECK(bond <= 3.1);
}

TEST_CASE("hard cases: no search misses what is known of a pair") {
  std::ifstream file(SUPERNORMAL_TEST_DATA "/known_pairs.txt");
  KnownPair pair;
  int pairs = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    std::vector<double> x;
    for (std::string word; key != "#" && words >> word;) x.push_back(std::strtod(word.c_str(), nullptr));
    if (key == "#") {
      if (pair.name.empty()) pair.name = line;
    } else if (key.empty()) {
      pair = {};
    } else if (key == "rounded") {
      pair.bodies.back().rounding = x[0];
    } else if (key == "callbacks") {
      pair.bodies.back().is_callback = true;
    } else if (key == "at") {
      pair.pose2.position = {x[0], x[1], x[2]};
    } else if (key == "rotation") {
      pair.pose2.rotation << x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8];
    } else if (key == "tolerance") {
      pair.settings.tolerance = x[0];
    } else if (key == "first") {
      pair.first_normal = {x[0], x[1], x[2]};
    } else if (pair.bodies.size() < 2) {
      pair.bodies.push_back(body_of(key, x));
    } else {
      check(pair, key, x);
      ++pairs;
    }
  }
  CHECK(pairs == 41);
}
