// The least of several quadratic pieces: its maximum against a brute-force search.
#include "proximity/local/piecewise_model.hpp"

#include <doctest/doctest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <vector>

#include "proximity/local/strict_complementarity.hpp"
#include "support/draw.hpp"
#include "support/relative.hpp"

using namespace supernormal;

namespace {

double gain(const PiecewiseModel& model, const Vector2& u) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Piece& piece : model.pieces) lowest = std::min(lowest, piece.at(u));
  return lowest - 0.5 * u.dot(model.A * u);
}

/// The highest of rings of points around u, from radius 4 down by so many halvings, relative to gain(u).
double best_rise(const PiecewiseModel& model, const Vector2& u, int halvings) {
  double rise = -std::numeric_limits<double>::infinity();
  for (int halving = 0; halving < halvings; ++halving) {
    const double size = std::ldexp(4.0, -halving);
    for (int k = 0; k < 64; ++k) {
      const double angle = 0.1 * halving + 2 * std::acos(-1.0) * k / 64;
      rise = std::max(rise, gain(model, u + size * Vector2(std::cos(angle), std::sin(angle))) - gain(model, u));
    }
  }
  return rise;
}

struct ModelDraw : test::Draw {
  ModelDraw() : Draw(3) {}

  Symmetric2 definite() {
    const double xx = std::exp(gauss()), yy = std::exp(gauss());
    return {xx, std::tanh(gauss()) * std::sqrt(xx * yy), yy};
  }

  std::vector<Piece> pieces(std::size_t count) {
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < count; ++k) pieces.push_back({k == 0 ? 0 : std::abs(gauss()), Vector2{gauss(), gauss()}});
    return pieces;
  }
};

}  // namespace

TEST_CASE("the maximum of a concave model is one: nothing around it is higher") {
  ModelDraw draw;
  int met[4] = {};
  for (int k = 0; k < 2000; ++k) {
    const std::vector<Piece> pieces = draw.pieces(1 + static_cast<std::size_t>(k) % 12);
    const PiecewiseModel model{pieces, draw.definite()};
    const PiecewiseModel::Peak peak = model.maximize();
    CHECK(peak.gain == test::relative(gain(model, peak.u)).epsilon(1e-9));
    CHECK(best_rise(model, peak.u, 22) <= 1e-12 * (1 + peak.u.squaredNorm()));
    ++met[peak.count];
  }
  for (int count = 1; count <= 3; ++count) CHECK(met[count] > 100);
}

TEST_CASE("the active pieces meet at the maximum, and their weighted slopes balance the curvature") {
  ModelDraw draw;
  for (int k = 0; k < 2000; ++k) {
    const std::vector<Piece> pieces = draw.pieces(8);
    const PiecewiseModel model{pieces, draw.definite()};
    const PiecewiseModel::Peak peak = model.maximize();
    const double height = peak.gain + 0.5 * peak.u.dot(model.A * peak.u);
    Vector2 slope = Vector2::Zero();
    double sum = 0;
    for (std::size_t i = 0; i < peak.count; ++i) {
      const Piece& piece = pieces[peak.active[i]];
      CHECK(piece.at(peak.u) == test::relative(height).epsilon(1e-9));
      CHECK(peak.weight[i] >= 0);
      slope += peak.weight[i] * piece.slope;
      sum += peak.weight[i];
    }
    CHECK(sum == test::relative(1));
    CHECK((slope - model.A * peak.u).norm() <= 1e-9 * (1 + (model.A * peak.u).norm()));
  }
}

TEST_CASE("within a radius the gain is positive whatever the curvature, and as large as the first-order bound allows") {
  ModelDraw draw;
  for (int k = 0; k < 2000; ++k) {
    const std::vector<Piece> pieces = draw.pieces(1 + static_cast<std::size_t>(k) % 8);
    const Symmetric2 A{draw.gauss(), draw.gauss(), draw.gauss()};
    const double radius = std::exp(2 * draw.gauss());
    const PiecewiseModel model{pieces, A};
    const PiecewiseModel::Peak peak = model.maximize(radius);
    CHECK(peak.u.norm() <= 1.11 * radius);
    CHECK(peak.gain == test::relative(gain(model, peak.u)).epsilon(1e-7));
    // At u = 0 the first piece is the lowest: there is always an ascent unless two others stop it there.
    CHECK(gain(model, peak.u) >= -1e-12 * (1 + radius * radius));
  }
}

TEST_CASE("coplanar vertices: many pieces meet in one point") {
  std::vector<Piece> ring;
  ring.reserve(20);
  for (int k = 0; k < 20; ++k) ring.push_back({0, Vector2(std::cos(0.3 * k), std::sin(0.3 * k)) + Vector2(0.2, -0.1)});
  const PiecewiseModel model{ring, {1, 0, 1}};
  const PiecewiseModel::Peak peak = model.maximize();
  CHECK(peak.u.norm() <= 1e-15);
  CHECK(std::abs(peak.gain) <= 1e-15);
  Vector2 slope = Vector2::Zero();
  for (std::size_t i = 0; i < peak.count; ++i) slope += peak.weight[i] * ring[peak.active[i]].slope;
  CHECK(slope.norm() <= 1e-14);
}

TEST_CASE("pieces that repeat or are parallel, and no curvature at all, divide by nothing") {
  const std::vector<Piece> same(3, {0, {1, 2}});
  CHECK(PiecewiseModel{same, {1, 0, 1}}.maximize().gain == test::relative(2.5));
  const std::vector<Piece> parallel = {{0, {1, 0}}, {1, {-1, 0}}, {0.5, {0.5, 0}}};
  const PiecewiseModel::Peak ridge = PiecewiseModel{parallel, {1, 0, 1}}.maximize();
  CHECK(ridge.u.x() == test::relative(0.5));
  CHECK(ridge.u.y() == 0);
  const std::vector<Piece> level = {{0, {0, 0}}};
  const PiecewiseModel::Peak rest = PiecewiseModel{level, {0, 0, 0}}.maximize(1);
  CHECK(rest.u.allFinite());
}

TEST_CASE("pieces that are parallel but for rounding meet nowhere, and raise no floating-point exception") {
  const std::vector<Piece> pieces = {{0, {0, 0}}, {-1, {1, 0}}, {-3, {2, 1e-210}}};
  std::feclearexcept(FE_ALL_EXCEPT);
  const PiecewiseModel::Peak peak = PiecewiseModel{pieces, {1e54, 0, 1e-13}}.maximize();
  CHECK(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == 0);
  CHECK(peak.u.allFinite());
  CHECK(peak.gain == test::relative(-3));
}

TEST_CASE("where there is no piece, nothing bounds the gain and nothing is active") {
  for (const PiecewiseModel::Peak& peak : {PiecewiseModel{{}, {1, 0, 1}}.maximize(), PiecewiseModel{{}, {1, 0, 1}}.maximize(0.5)}) {
    CHECK(peak.count == 0);
    CHECK(peak.u == Vector2::Zero());
    CHECK(peak.gain == std::numeric_limits<double>::infinity());
  }
}

TEST_CASE("vertices tied at a normal determine it together, whatever the support function is rounded to") {
  constexpr double kRounding = 1e-16;
  const StrictComplementarity hold(kRounding, 1);
  const Symmetric2 saddle{-1, 0, 1};
  for (const double level : {0.0, 0.5 * kRounding, 3 * kRounding, 1.0}) {
    const std::vector<Piece> edge = {{level, {1, 0}}, {level, {-1, 0}}, {level + 2, {0, 1}}};
    const Symmetric2 held = hold.reduced_hessian(saddle, edge);
    CHECK(held.xx > 0);
    CHECK(held.yy == 1);
  }
}
