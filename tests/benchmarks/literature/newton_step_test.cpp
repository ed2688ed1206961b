#include "literature/newton_step.hpp"

#include <doctest/doctest.h>

#include <limits>

using Eigen::Matrix2d;
using Eigen::Vector2d;
using literature::newton_step;
using literature::newton_step_of_any_rank;

TEST_CASE("literature: a step of Newton's method solves its linear system") {
  const Matrix2d jacobian{{1, 2}, {3, 5}};
  const auto step = newton_step(jacobian, Vector2d(4, 11));
  REQUIRE(step.has_value());
  CHECK((jacobian * *step - Vector2d(4, 11)).norm() < 1e-14);
}

TEST_CASE("literature: a matrix that is singular to the bit has no step, without a division by zero") {
  const Matrix2d of_rank_1{{1, 2}, {2, 4}};
  CHECK_FALSE(newton_step(of_rank_1, Vector2d(1, 2)).has_value());
  CHECK_FALSE(newton_step(Matrix2d(Matrix2d::Zero()), Vector2d(1, 2)).has_value());
  const auto step = newton_step_of_any_rank(of_rank_1, Vector2d(1, 2));
  REQUIRE(step.has_value());
  CHECK((of_rank_1 * *step - Vector2d(1, 2)).norm() < 1e-14);
}

TEST_CASE("literature: numbers that are not finite have no step") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Matrix2d jacobian{{1, none}, {3, 5}};
  CHECK_FALSE(newton_step(jacobian, Vector2d(4, 11)).has_value());
  CHECK_FALSE(newton_step_of_any_rank(jacobian, Vector2d(4, 11)).has_value());
  CHECK_FALSE(newton_step_of_any_rank(Matrix2d(Matrix2d::Identity()), Vector2d(none, 1)).has_value());
}
