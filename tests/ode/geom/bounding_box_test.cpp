// Tests that the bounding box encloses the body, and that no axis-parallel box is smaller.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/ode_fixture.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

struct Box {
  std::array<dReal, 6> side{};
  explicit Box(dGeomID geom) { dGeomGetAABB(geom, side.data()); }
};

// Visits boundary points without our library, by superquadric coordinates and an own rotation.
template <typename Visit>
void visit_boundary(const Vec& axes, double delta, double epsilon, int steps, Visit visit) {
  const auto power = [](double base, double exponent) { return std::copysign(std::pow(std::abs(base), exponent), base); };
  const double pi = std::acos(-1.0);
  for (int i = 0; i <= steps; ++i) {
    const double theta = -pi / 2 + pi * i / steps;
    for (int j = 0; j < 2 * steps; ++j) {
      const double phi = pi * j / steps;
      const double waist = power(std::cos(theta), 2 / epsilon);
      visit(Vec{axes[0] * waist * power(std::cos(phi), 2 / delta), axes[1] * waist * power(std::sin(phi), 2 / delta),
                axes[2] * power(std::sin(theta), 2 / epsilon)});
    }
  }
}

Vec to_world(dGeomID geom, const Vec& local) {
  const dReal* const R = dGeomGetRotation(geom);
  const dReal* const p = dGeomGetPosition(geom);
  Vec world{};
  for (std::size_t row = 0; row < 3; ++row) {
    world[row] = p[row] + R[4 * row] * local[0] + R[4 * row + 1] * local[1] + R[4 * row + 2] * local[2];
  }
  return world;
}

}  // namespace

TEST_CASE("the bounding box of an ellipsoid in any orientation has the closed form") {
  OdeSession session;
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec axes = {random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2)};
    const Geom geom(snCreateEllipsoid(nullptr, dReal(axes[0]), dReal(axes[1]), dReal(axes[2])));
    random.turn(geom);
    place(geom, {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)});
    const Box box(geom);
    const dReal* const R = dGeomGetRotation(geom);
    const dReal* const p = dGeomGetPosition(geom);
    for (std::size_t k = 0; k < 3; ++k) {
      const double half = norm({R[4 * k] * axes[0], R[4 * k + 1] * axes[1], R[4 * k + 2] * axes[2]});
      CHECK(std::abs(box.side[2 * k] - (p[k] - half)) < within_rounding(5e-14, 4));
      CHECK(std::abs(box.side[2 * k + 1] - (p[k] + half)) < within_rounding(5e-14, 4));
      CHECK(box.side[2 * k] <= p[k] - half);
      CHECK(box.side[2 * k + 1] >= p[k] + half);
    }
  }
}

TEST_CASE("the bounding box of a superellipsoid agrees with dense sampling of the boundary") {
  OdeSession session;
  Random random(8);
  for (int i = 0; i < 30; ++i) {
    const Vec axes = {random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2)};
    const double delta = random.uniform(1.3, 8);
    const double epsilon = random.uniform(1.3, 8);
    CAPTURE(delta);
    CAPTURE(epsilon);
    const Geom geom(snCreateSuperellipsoid(nullptr, dReal(axes[0]), dReal(axes[1]), dReal(axes[2]), dReal(delta), dReal(epsilon)));
    random.turn(geom);
    place(geom, {random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)});
    const Box box(geom);
    std::array<double, 6> sampled = {1e9, -1e9, 1e9, -1e9, 1e9, -1e9};
    visit_boundary(axes, delta, epsilon, 200, [&](const Vec& local) {
      const Vec world = to_world(geom, local);
      for (std::size_t k = 0; k < 3; ++k) {
        sampled[2 * k] = std::min(sampled[2 * k], world[k]);
        sampled[2 * k + 1] = std::max(sampled[2 * k + 1], world[k]);
      }
    });
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(box.side[2 * k] <= sampled[2 * k] + 1e-14);  // the sample itself is rounded
      CHECK(box.side[2 * k + 1] >= sampled[2 * k + 1] - 1e-14);
      CHECK(box.side[2 * k] > sampled[2 * k] - 5e-3);  // the grid is 1.6 hundredths of a radian
      CHECK(box.side[2 * k + 1] < sampled[2 * k + 1] + 5e-3);
    }
  }
}

TEST_CASE("the bounding box contains the support points, also far from the origin") {
  OdeSession session;
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const Geom geom(random_body(random));
    const double scale = std::pow(10.0, random.uniform(0, 6));
    place(geom, scale * random.direction());
    const Box box(geom);
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int sign : {-1, 1}) {
        dVector3 direction = {0, 0, 0, 0};
        direction[k] = dReal(sign);
        dVector3 point;
        REQUIRE(snGeomSupport(geom, direction, point) == 1);
        const std::size_t side = 2 * k + (sign > 0 ? 1 : 0);
        CHECK(dReal(sign) * box.side[side] >= dReal(sign) * point[k]);
        CHECK(std::abs(box.side[side] - point[k]) < within_rounding(1e-13) * (1 + scale));
      }
    }
  }
}

TEST_CASE("the bounding box follows the parameters, the rounding and the pose") {
  OdeSession session;
  const Geom geom(snCreateEllipsoid(nullptr, 1, 2, 3));
  const auto check_half = [&](double x, double y, double z) {
    const Box box(geom);
    CHECK(box.side[1] == relative(x).epsilon(within_rounding(1e-14)));
    CHECK(box.side[3] == relative(y).epsilon(within_rounding(1e-14)));
    CHECK(box.side[5] == relative(z).epsilon(within_rounding(1e-14)));
  };
  check_half(1, 2, 3);
  REQUIRE(snGeomSuperellipsoidSetParams(geom, 4, 5, 6, 8, 8) == 1);
  check_half(4, 5, 6);
  REQUIRE(snGeomSetRounding(geom, dReal(0.5)) == 1);
  check_half(4.5, 5.5, 6.5);
  REQUIRE(snGeomSuperellipsoidSetParams(geom, 1, 1, 1, 2, 2) == 1);
  check_half(1.5, 1.5, 1.5);  // the rounding stays
  REQUIRE(snGeomSetRounding(geom, 0) == 1);
  check_half(1, 1, 1);
  dGeomSetPosition(geom, 10, 0, 0);
  check_half(11, 1, 1);
}
