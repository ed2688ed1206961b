// Tests of resistance to rolling and spinning. Both coefficients are lengths.
#include <doctest/doctest.h>

#include <utility>

#include "effects/effects_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

TEST_CASE("a ball rolls by (7/10) v^2 R / (g rho) in every direction") {
  // The torque against rolling is rho N, so the deceleration is (5/7) g rho / R.
  const double rho = 2e-3;
  const double speed = 0.5;
  for (const std::pair<double, double>& both :
       {std::pair(0.0, kStep), {0.3, kStep}, {45 * kDegree, kStep}, {1.2, kStep}, {0.3, 1e-3}, {1.2, 1e-2}}) {
    const double angle = both.first, step = both.second;
    CAPTURE(angle);
    CAPTURE(step);
    std::vector<fx::Effect> list = {earth(), fx::Friction{0.5, {}}, fx::RollingResistance{rho, 0, {}}};
    if (step > kStep) list.emplace_back(fx::SpeculativeContacts{});
    OnPlane scene(list, step);
    const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
    scene.run_until(0.05);
    const Vec start = to_vec(dBodyGetPosition(ball));
    const Vec v = {speed * std::cos(angle), speed * std::sin(angle), 0};
    dBodySetLinearVel(ball, dReal(v[0]), dReal(v[1]), 0);
    dBodySetAngularVel(ball, dReal(-v[1] / kBallRadius), dReal(v[0] / kBallRadius), 0);
    scene.run_until(3, [&] { return norm(to_vec(dBodyGetLinearVel(ball))) < 1e-4; });
    const Vec way = to_vec(dBodyGetPosition(ball)) - start;
    CHECK(std::hypot(way[0], way[1]) == relative(0.7 * speed * speed * kBallRadius / (kGravity * rho)).epsilon(0.01));
    CHECK(std::abs(std::atan2(way[1], way[0]) - angle) < 0.02);
  }
}

TEST_CASE("a ball rests on an incline up to tan = rho / R in every direction") {
  const double rho = 2.5e-3;  // 2.86 degrees
  for (const double part : {0.97, 1.03}) {
    for (const double turn : {0.0, 0.3}) {
      CAPTURE(part);
      CAPTURE(turn);
      const double angle = std::atan(part * rho / kBallRadius);
      const double across = kGravity * std::sin(angle);
      const fx::Gravity leaning{{across * std::cos(turn), across * std::sin(turn), -kGravity * std::cos(angle)}};
      OnPlane scene({leaning, fx::Friction{0.5, {}}, fx::RollingResistance{rho, 0, {}}}, kStep);
      const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
      scene.run_until(1);
      const double speed = norm(to_vec(dBodyGetLinearVel(ball)));
      const double expected = part < 1 ? 0 : 5.0 / 7 * (across - kGravity * std::cos(angle) * rho / kBallRadius);
      CHECK(std::abs(speed - expected) < 2e-3);
    }
  }
}

TEST_CASE("a spinning ball stops after (2/5) R^2 w / (g rho)") {
  const double rho = 1e-3;
  const double spin = 20;
  for (const bool rough : {true, false}) {
    std::vector<fx::Effect> list = {earth(), fx::RollingResistance{0, rho, {}}};
    if (rough) list.emplace_back(fx::Friction{0.5, {}});
    OnPlane scene(list, kStep);
    const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
    scene.run_until(0.05);
    dBodySetAngularVel(ball, 0, 0, dReal(spin));
    const double time = scene.run_until(5, [&] { return std::abs(dBodyGetAngularVel(ball)[2]) < 1e-3; });
    CHECK(time == relative(0.4 * kBallRadius * kBallRadius * spin / (kGravity * rho)).epsilon(0.01));
  }
}
