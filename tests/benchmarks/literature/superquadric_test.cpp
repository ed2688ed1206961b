// Tests of the descriptions of the literature: derivatives against differences, and the descriptions against each other; and the
// step of Newton's method.
#include "literature/superquadric.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "literature/newton_step.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

using namespace literature;
using Eigen::Matrix2d;

namespace {

constexpr double kStep = 1e-6;        // step of central differences; their error is about its square
constexpr double kDifference = 1e-7;  // relative: the rounding of the function over the step, and the square of the step

std::vector<Superquadric> bodies() {
  return {{{1, 1.4, 0.8}, 2, 2}, {{0.7, 1.2, 1}, 3, 5}, {{1, 0.6, 1.5}, 1.5, 4}, {{1, 1, 1}, 6, 2}, {{1, 0.9, 1.1}, 4, 4}};
}

Vector2 random_angles(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> latitude(-1.4, 1.4), longitude(-3.1, 3.1);
  return {latitude(engine), longitude(engine)};
}

template <typename Value, typename Argument>
Value difference(const auto& function, const Argument& at, int k) {
  Argument up = at, down = at;
  up[k] += kStep;
  down[k] -= kStep;
  return (function(up) - function(down)) / (2 * kStep);
}

}  // namespace

TEST_CASE("superquadric: the implicit function's derivatives agree with finite differences") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> coordinate(0.1, 1.2);
  for (const Superquadric& body : bodies()) {
    for (int i = 0; i < 50; ++i) {
      const Vector3 x(coordinate(engine), -coordinate(engine), coordinate(engine));
      const Implicit f = body.implicit(x);
      CHECK(f.value == doctest::Approx(body.value(x)).epsilon(1e-12));
      for (int k = 0; k < 3; ++k) {
        const auto slope = difference<double>([&](const Vector3& y) { return body.value(y); }, x, k);
        CHECK(std::abs(f.gradient[k] - slope) <= kDifference * (1 + f.gradient.norm() + std::abs(f.value)));
        const auto column = difference<Vector3>([&](const Vector3& y) -> Vector3 { return body.implicit(y).gradient; }, x, k);
        CHECK((f.hessian.col(k) - column).norm() <= kDifference * (1 + f.hessian.norm() + f.gradient.norm()));
      }
    }
  }
}

TEST_CASE("superquadric: the points by angles are on the surface, with the gradient as normal") {
  std::mt19937_64 engine(2);
  for (const Superquadric& body : bodies()) {
    for (int i = 0; i < 50; ++i) {
      const Vector2 angles = random_angles(engine);
      const SurfacePoint surface = body.surface(angles);
      const Implicit f = body.implicit(surface.point);
      CHECK(std::abs(f.value) <= 1e-12);
      CHECK((surface.normal.normalized() - f.gradient.normalized()).norm() <= 1e-9);
      CHECK((surface.point - body.point(angles)).norm() <= 1e-14);
      CHECK((body.point(body.angles_of(3 * surface.normal)) - surface.point).norm() <= 1e-9);
      for (int k = 0; k < 2; ++k) {
        const auto point = difference<Vector3>([&](const Vector2& a) -> Vector3 { return body.surface(a).point; }, angles, k);
        const auto normal = difference<Vector3>([&](const Vector2& a) -> Vector3 { return body.surface(a).normal; }, angles, k);
        const double near_axis =
            1 / std::pow(std::sin(2 * angles[0]) * std::sin(2 * angles[1]), 2);  // third derivatives grow there
        CHECK((surface.point_rate.col(k) - point).norm() <= kDifference * (1 + near_axis));
        CHECK((surface.normal_rate.col(k) - normal).norm() <= kDifference * (1 + near_axis));
      }
    }
  }
}

TEST_CASE("superquadric: the library's point of a normal is the point of this normal's angles") {
  std::mt19937_64 engine(3);
  for (const Superquadric& body : bodies()) {
    const supernormal::Superellipsoid shape(body.half_axes, body.delta, body.epsilon);
    for (int i = 0; i < 50; ++i) {
      const Vector3 normal = body.surface(random_angles(engine)).normal.normalized();
      CHECK((body.point(body.angles_of(normal)) - shape.point(normal)).norm() <= 1e-9);
    }
  }
}

TEST_CASE("tangents: they form an orthonormal frame with the normal, and their derivatives agree with finite differences") {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 100; ++i) {
    const Vector3 normal = Vector3(gauss(engine), gauss(engine), gauss(engine)).normalized();
    const Tangents tangents = tangents_of(normal);
    CHECK(std::abs(tangents.tangent[0].dot(normal)) <= 1e-15);
    CHECK(std::abs(tangents.tangent[1].dot(normal)) <= 1e-15);
    CHECK(std::abs(tangents.tangent[0].dot(tangents.tangent[1])) <= 1e-15);
    const Vector3 turn = normal.cross(Vector3(gauss(engine), gauss(engine), gauss(engine))).normalized();
    const Tangents up = tangents_of((normal + kStep * turn).normalized());
    const Tangents down = tangents_of((normal - kStep * turn).normalized());
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK((tangents.rate[k] * turn - (up.tangent[k] - down.tangent[k]) / (2 * kStep)).norm() <= kDifference);
    }
  }
  for (const double x : {1.0, -1.0}) CHECK(tangents_of(x * Vector3::UnitX()).tangent[0].allFinite());
}

TEST_CASE("literature: a step of Newton's method solves its linear system") {
  const Matrix2d jacobian{{1, 2}, {3, 5}};
  const auto step = newton_step(jacobian, Vector2(4, 11));
  REQUIRE(step.has_value());
  CHECK((jacobian * *step - Vector2(4, 11)).norm() < 1e-14);
}

TEST_CASE("literature: a matrix that is singular to the bit has no step, without a division by zero") {
  const Matrix2d of_rank_1{{1, 2}, {2, 4}};
  CHECK_FALSE(newton_step(of_rank_1, Vector2(1, 2)).has_value());
  CHECK_FALSE(newton_step(Matrix2d(Matrix2d::Zero()), Vector2(1, 2)).has_value());
  const auto step = newton_step_of_any_rank(of_rank_1, Vector2(1, 2));
  REQUIRE(step.has_value());
  CHECK((of_rank_1 * *step - Vector2(1, 2)).norm() < 1e-14);
}

TEST_CASE("literature: numbers that are not finite have no step") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Matrix2d jacobian{{1, none}, {3, 5}};
  CHECK_FALSE(newton_step(jacobian, Vector2(4, 11)).has_value());
  CHECK_FALSE(newton_step_of_any_rank(jacobian, Vector2(4, 11)).has_value());
  CHECK_FALSE(newton_step_of_any_rank(Matrix2d(Matrix2d::Identity()), Vector2(none, 1)).has_value());
}
