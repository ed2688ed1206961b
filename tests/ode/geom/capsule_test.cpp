// Tests of snCreateCapsule: a capsule of ours beside ODE's own.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

constexpr dReal kRadius = 2, kLength = 5;

}  // namespace

TEST_CASE("capsule: size, mass and depth are equal to ODE's") {
  OdeSession session;
  const Geom ours(snCreateCapsule(nullptr, kRadius, kLength));
  REQUIRE(ours != nullptr);
  const Geom odes(dCreateCapsule(nullptr, kRadius, kLength));
  dMatrix3 turn;
  dRFromAxisAndAngle(turn, 1, dReal(0.5), dReal(0.2), dReal(0.7));
  std::array<std::array<dReal, 6>, 2> boxes{};
  for (const auto geom : {static_cast<dGeomID>(ours), static_cast<dGeomID>(odes)}) {
    dGeomSetRotation(geom, turn);
    dGeomGetAABB(geom, boxes[geom == static_cast<dGeomID>(odes) ? 1 : 0].data());
  }
  // Ours is wider by the rounding error that it must cover.
  const double tolerance = within_rounding(1e-6, kRadius + 0.5 * kLength);
  for (std::size_t i = 0; i < 6; ++i) {
    const double wider = (i % 2 == 0 ? -1 : 1) * (double{boxes[0][i]} - double{boxes[1][i]});
    CHECK(wider < tolerance);
    CHECK(wider > -0.1 * tolerance);
  }
  dMass mass, expected;
  REQUIRE(snMassSet(&mass, 3, ours) == 1);
  dMassSetCapsule(&expected, 3, 3, kRadius, kLength);
  CHECK(mass.mass == relative(expected.mass).epsilon(1e-6));
  for (const int i : {0, 5, 10}) CHECK(mass.I[i] == relative(expected.I[i]).epsilon(1e-6));
  for (const dReal x : {dReal(0), dReal(1), dReal(3)}) {
    CHECK(std::abs(snGeomPointDepth(ours, x, 1, 2) - dGeomCapsulePointDepth(odes, x, 1, 2)) < 1e-6);
  }
}

TEST_CASE("capsule: a capsule that falls on its side, slightly tilted, stays still at any step and max_contacts, on any geom") {
  OdeSession session;
  for (const bool is_on_box : {false, true}) {
    for (const double step : {0.005, 0.02, 0.05}) {
      for (const int room : {2, 3, 4, 8}) {
        World world(dSimpleSpaceCreate(nullptr));
        world.room = room;
        world.surface.mu = dReal(0.5);
        if (is_on_box) {
          place(dCreateBox(world.space(), 4, 4, 1), {0, 0, -0.5});
        } else {
          world.add_plane();
        }
        const dBodyID body = world.add(snCreateCapsule(world.space(), dReal(0.1), dReal(0.4)), 1000);
        turn(body, {1, 0, 0}, 1.62);
        set_position(body, {0, 0, 0.3});
        double late_spin = 0;
        const int steps = static_cast<int>(5 / step);
        for (int k = 0; k < steps; ++k) {
          world.quick_step(step);
          if (k > 0.8 * steps) late_spin = std::max(late_spin, norm(to_vec(dBodyGetAngularVel(body))));
        }
        CAPTURE(is_on_box);
        CAPTURE(step);
        CAPTURE(room);
        CHECK(late_spin <= within_rounding(1e-6, 1000));  // a dCapsule on a dBox has 0.2, 1.5 and 1.9
        CHECK(dBodyGetPosition(body)[2] >= 0.0995);
      }
    }
  }
}

TEST_CASE("capsule: invalid parameters are refused") {
  OdeSession session;
  CHECK(refused(snCreateCapsule(nullptr, 0, 1), "snCreateCapsule: radius = 0"));
  CHECK(refused(snCreateCapsule(nullptr, 1, -1), "snCreateCapsule: length = -1"));
  const Geom ball(snCreateCapsule(nullptr, 1, 0));
  CHECK(ball != nullptr);
}
