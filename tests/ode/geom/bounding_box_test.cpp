// Tests that the bounding box encloses the body, and that no axis-parallel box is smaller. The core tests support functions.
#include <doctest/doctest.h>

#include "support/ode_fixture.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

struct Box {
  std::array<dReal, 6> side{};
  explicit Box(dGeomID geom) { dGeomGetAABB(geom, side.data()); }
};

}  // namespace

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
