// The maxima of a quadratic model in a disc, and of the least of several quadratic pieces, beside searches of many points.
#include "proximity/local/trust_region.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "proximity/local/piecewise_model.hpp"
#include "proximity/local/strict_complementarity.hpp"
#include "support/draw.hpp"
#include "support/relative.hpp"
#include "support/traps.hpp"

using namespace supernormal;

namespace {

/// The largest gain in the disc: at the stationary point if that is a maximum inside, or on the circle.
double largest_sampled(const QuadraticModel& model, double radius) {
  const int spokes = test::draws(20000);
  double largest = 0;
  for (int spoke = 0; spoke < spokes; ++spoke) {
    const double angle = 2 * std::numbers::pi * spoke / spokes;
    const Vector2 direction(std::cos(angle), std::sin(angle));
    largest = std::max(largest, model.gain(radius * direction));
    // Along a ray: the vertex of the parabola if it lies inside.
    const double bend = direction.dot(model.A * direction);
    const double slope = model.g.dot(direction);
    if (bend > 0 && slope > 0 && slope / bend < radius) largest = std::max(largest, 0.5 * slope * (slope / bend));
  }
  return largest;
}

Symmetric2 with_eigenvalues(double low, double high, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {high * c * c + low * s * s, (high - low) * c * s, high * s * s + low * c * c};
}

/// A step to the circle is only a trial: the solver lets it miss the circle by a hundredth.
constexpr double kShare = 0.97;

void check(const QuadraticModel& model, double radius) {
  const Vector2 u = model.maximize(radius);
  const double largest = largest_sampled(model, radius);
  CHECK(u.allFinite());
  CHECK(u.norm() <= radius * (1 + 1e-2));
  const double gain = model.gain(u);
  if (!(gain >= kShare * largest - 1e-15)) {
    FAIL_CHECK("g ", model.g.x(), " ", model.g.y(), " A ", model.A.xx, " ", model.A.xy, " ", model.A.yy, " radius ", radius,
               " gain ", gain, " of ", largest);
  }
}

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

TEST_CASE("random models: definite, indefinite and negative") {
  test::Draw draw(61);
  for (int trial = 0; trial < test::draws(300); ++trial) {
    const QuadraticModel model{{draw.gauss(), draw.gauss()}, {2 * draw.gauss(), draw.gauss(), 2 * draw.gauss()}};
    for (const double radius : {1e-3, 0.3, 1.0, 4.0}) check(model, radius);
  }
}

TEST_CASE("the Newton step where it fits") {
  const QuadraticModel model{{0.3, -0.2}, {2, 0.5, 1}};
  const Vector2 u = model.maximize(1);
  CHECK((model.A * u - model.g).norm() <= 1e-15);
  CHECK(std::abs(model.gain(u) - model.largest_gain()) <= 1e-16);
}

TEST_CASE("the hard case: no slope along the negative curvature") {
  for (const double low : {-1e-6, -1.0, -1e3}) {
    for (const double slope : {0.0, 1e-300, 1e-17, 1e-9, 0.1, 10.0}) {
      for (const double angle : {0.0, 0.3, 1.2}) {
        for (const double noise : {0.0, 1e-300, -1e-20, 1e-17}) {
          const Symmetric2 A = with_eigenvalues(low, 1.25, angle);
          const Vector2 up(std::cos(angle), std::sin(angle)), across(-up.y(), up.x());
          for (const double radius : {1e-6, 1e-2, 1.0}) check({slope * up + noise * across, A}, radius);
        }
      }
    }
  }
}

TEST_CASE("both curvatures negative and equal") {
  for (const Vector2& g : {Vector2(0, 0), Vector2(1e-17, 0), Vector2(1e-300, 1e-300), Vector2(0.1, -0.4)}) {
    for (const double radius : {1e-8, 1.0, 4.0}) check(QuadraticModel{g, {-1.25, 0, -1.25}}, radius);
  }
}

TEST_CASE("nothing to gain: no step") {
  CHECK(QuadraticModel{{0, 0}, {1, 0, 2}}.maximize(1) == Vector2::Zero());
  CHECK(QuadraticModel{{0, 0}, {1, 0, 2}}.largest_gain() == 0);
}

TEST_CASE("the largest gain is infinite where some way leads up for ever") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CHECK(QuadraticModel{{0.1, 0}, {1, 0, -1e-9}}.largest_gain() == kInfinity);
  CHECK(QuadraticModel{{0.1, 0}, {1, 0, 0}}.largest_gain() == kInfinity);
  CHECK(QuadraticModel{{0.1, 0}, {1, 0, 1e-9}}.largest_gain() < 1);
}

TEST_CASE("one radius of curvature beyond all measure leaves the other its digits") {
  for (const double huge : {1e20, 1e60, 1e120}) {
    const QuadraticModel model{{0.3, 0.2}, {huge, 0, 2}};
    const test::Traps traps("the maximum of a model");
    const Vector2 u = model.maximize(1);
    CHECK(std::abs(u.y() - 0.1) <= 1e-15);
    CHECK(std::abs(u.x()) <= 0.3 / huge * (1 + 1e-12));
    CHECK(std::abs(model.largest_gain() - 0.01) <= 1e-15);
    const Eigen2 e(model.A);
    CHECK(e.low == 2);
    CHECK(e.high == huge);
    // And with the circle in the way.
    const Vector2 rim = model.maximize(0.01);
    CHECK(std::abs(rim.y() - 0.01) <= 1e-4);
    CHECK(std::abs(rim.x()) <= 1e-10);
  }
}

TEST_CASE("one curvature is next to nothing, the other that over again: no overflow on the way to the circle") {
  const QuadraticModel model{{1.2706869609825529e-225, 0},
                             {8.8208958574947383e-211, 1.7849350496270764e-239, 3.6118702486213016e-268}};
  const test::Traps traps("the maximum of a model");
  const Vector2 u = model.maximize(1);
  CHECK(u.norm() <= 1 + 1e-15);
  CHECK(model.gain(u) >= 0);
}

TEST_CASE("slopes and curvatures of next to nothing: the step is the one along the axis that has both") {
  struct Case {
    QuadraticModel model;
    Vector2 step;
  };
  const Case cases[] = {{{{1e-312, 0}, {0, 0, 0}}, {0, 0}},
                        {{{-3.6357697429871883e-283, -3.3005054434138124e-314}, {1.9871563776991301e-165, 0, 0}},
                         {-3.6357697429871883e-283 / 1.9871563776991301e-165, 0}},
                        {{{0, 1e-196}, {0, 0, 2e-20}}, {0, 1e-196 / 2e-20}},
                        {{{1e-196, 0}, {2e-20, 0, 0}}, {1e-196 / 2e-20, 0}}};
  const test::Traps traps("the maximum of a model");
  for (const auto& [model, step] : cases) CHECK(model.maximize(1) == step);
}

TEST_CASE("eigenvalues and vectors") {
  test::Draw draw(62);
  for (int trial = 0; trial < 1000; ++trial) {
    const Symmetric2 A{draw.gauss(), draw.gauss(), draw.gauss()};
    const Eigen2 e(A);
    CHECK(e.low <= e.high);
    CHECK((A * e.low_vector - e.low * e.low_vector).norm() <= 4e-15);
    CHECK((A * e.high_vector - e.high * e.high_vector).norm() <= 4e-15);
    CHECK(std::abs(e.low_vector.dot(e.high_vector)) <= 1e-15);
    CHECK(std::abs(e.high_vector.norm() - 1) <= 1e-15);
    const Vector2 b{draw.gauss(), draw.gauss()};
    CHECK((A * A.solve(b) - b).norm() <= 1e-11 * (1 + A.solve(b).norm()));
  }
  const Eigen2 zero(Symmetric2{});
  CHECK(zero.low == 0);
  CHECK(zero.high == 0);
  CHECK(zero.high_vector.norm() == 1);
}

TEST_CASE("solved whatever the sizes of the radii, or singular") {
  const auto check = [](const Symmetric2& A, const Vector2& x) {
    const Vector2 solved = A.solve(A * x);
    CHECK((solved - x).cwiseAbs().cwiseQuotient(x.cwiseAbs()).maxCoeff() <= 1e-12);
  };
  check({1e25, 0, 1e-273}, {1e-25, 1});
  check({1e-273, 0, 1e25}, {1, 1e-25});
  check({1e120, 1e-60, 1e-150}, {1e-60, 1e40});
  check({1e-20, 3, -1e-30}, {2, -1});
  check({0, 1, 0}, {2, -1});
  CHECK(Symmetric2{1e25, 0, 1e-273}.solve({0.4, 0}) == Vector2(0.4 / 1e25, 0));
  for (const Symmetric2& singular : {Symmetric2{0, 0, 0}, Symmetric2{1, 0, 0}, Symmetric2{0, 0, 1}, Symmetric2{1, 1, 1}}) {
    CHECK_FALSE(singular.solve({1, 2}).allFinite());
  }
}

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
  const test::Traps traps("the maximum of a model");
  const PiecewiseModel::Peak peak = PiecewiseModel{pieces, {1e54, 0, 1e-13}}.maximize();
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
