// Forces on bodies, and adhesion, against closed forms.
#include <doctest/doctest.h>

#include "effects/effects_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

double falling_speed(EffectsWorld& scene, dBodyID body, double time) {
  scene.run_until(time);
  return -dBodyGetLinearVel(body)[2];
}

}  // namespace

TEST_CASE("the terminal velocity under quadratic drag has the projected area of the body") {
  const double density = 1.2;
  const double coefficient = 0.5;
  const double a = 0.03;
  const double b = 0.02;
  const double c = 0.01;
  const double mass = 1000 * 4.0 / 3 * std::numbers::pi * a * b * c;
  EffectsWorld scene({earth(), fx::QuadraticDrag{density, coefficient}}, 0.02);
  const dBodyID flat = scene.add_body({a, b, c}, 2, 1000, {0, 0, 0});
  const dBodyID tall = scene.add_body({a, b, c}, 2, 1000, {1, 0, 0});
  turn(tall, {0, 1, 0}, 90 * kDegree);
  const dBodyID box = scene.add_body({a, b, c}, 400, 1000, {2, 0, 0});
  const auto terminal = [&](double m, double area) { return std::sqrt(2 * m * kGravity / (density * coefficient * area)); };
  scene.run_until(40);
  CHECK(-dBodyGetLinearVel(flat)[2] == relative(terminal(mass, std::numbers::pi * a * b)).epsilon(1e-3));
  CHECK(-dBodyGetLinearVel(tall)[2] == relative(terminal(mass, std::numbers::pi * b * c)).epsilon(1e-3));
  CHECK(-dBodyGetLinearVel(box)[2] == relative(terminal(8000 * a * b * c, 4 * a * b)).epsilon(0.01));
}

TEST_CASE("the terminal velocity under Stokes drag is right, also in a thick fluid at a long step") {
  const double radius = 1e-3;
  for (const double viscosity : {1.0, 1e4}) {  // the second value stops a ball within a millionth of the step
    EffectsWorld scene({earth(), fx::StokesDrag{viscosity}}, kLongStep);
    const dBodyID ball = scene.add_ball(radius, 2500, {0, 0, 0});
    dBodySetLinearVel(ball, 1, 0, 0);
    const double expected = 2.0 / 9 * 2500 * kGravity * radius * radius / viscosity;
    CHECK(falling_speed(scene, ball, 0.2) == relative(expected).epsilon(within_rounding(1e-6, 300)));
    CHECK(std::abs(dBodyGetLinearVel(ball)[0]) < 1e-6);
  }
}

TEST_CASE("the Stokes drag of spheroids is within 4 % of Oberbeck's at aspect ratio 2, and within 10 % at 4") {
  // Clift, Grace and Weber, Bubbles, Drops, and Particles (1978), table 4.1: the drag relative to a sphere of the equatorial
  // radius.
  struct Spheroid {
    double aspect;  ///< polar over equatorial half-axis
    bool along;     ///< whether the spheroid moves along its polar axis
    double ratio;
  };
  const auto prolate_along = [](double e) {
    const double root = std::sqrt(e * e - 1);
    return 8.0 / 3 / ((2 * e * e - 1) / std::pow(root, 3) * std::log((e + root) / (e - root)) - 2 * e / (root * root));
  };
  const auto prolate_across = [](double e) {
    const double root = std::sqrt(e * e - 1);
    return 8.0 / 3 / ((2 * e * e - 3) / std::pow(root, 3) * std::log(e + root) + e / (root * root));
  };
  const auto oblate_along = [](double e) {
    const double root = std::sqrt(1 - e * e);
    return 8.0 / 3 / (2 * e / (root * root) + 2 * (1 - 2 * e * e) / std::pow(root, 3) * std::atan(root / e));
  };
  const std::vector<Spheroid> spheroids = {{2, true, prolate_along(2)},    {4, true, prolate_along(4)},
                                           {2, false, prolate_across(2)},  {4, false, prolate_across(4)},
                                           {0.5, true, oblate_along(0.5)}, {0.25, true, oblate_along(0.25)}};
  const double radius = 1e-3;
  for (const Spheroid& s : spheroids) {
    CAPTURE(s.aspect);
    CAPTURE(s.along);
    EffectsWorld scene({earth(), fx::StokesDrag{10}}, kLongStep);
    const dBodyID body = scene.add_body({radius, radius, radius * s.aspect}, 2, 2500, {0, 0, 0});
    if (!s.along) turn(body, {1, 0, 0}, 90 * kDegree);
    const double drag = mass_of(body) * kGravity / falling_speed(scene, body, 0.1);
    CHECK(drag / (6 * std::numbers::pi * 10 * radius) == relative(s.ratio).epsilon(s.aspect == 2 || s.aspect == 0.5 ? 0.04 : 0.1));
  }
}

TEST_CASE("an ellipsoid floats at the depth of its density") {
  // The fraction t = d / (2c) of the height below water solves 3 t^2 - 2 t^3 = density ratio.
  const double c = 0.03;
  for (const double ratio : {0.2, 0.5, 0.8}) {
    CAPTURE(ratio);
    double low = 0;
    double high = 1;
    for (int i = 0; i < 60; ++i) {
      const double t = 0.5 * (low + high);
      (3 * t * t - 2 * t * t * t < ratio ? low : high) = t;
    }
    const double level = 0.4;
    EffectsWorld scene({earth(), fx::Buoyancy{1000, level}, fx::Damping{5, 5}}, 2e-3);
    const dBodyID body = scene.add_body({0.06, 0.05, c}, 2, 1000 * ratio, {0, 0, level + 0.05});
    turn(body, {1, 1, 0}, 20 * kDegree);  // it rights itself
    scene.run_until(6);
    const double draught = level - (dBodyGetPosition(body)[2] - c);
    CHECK(draught == relative(2 * c * low).epsilon(0.01));
    CHECK(dBodyGetRotation(body)[10] > 0.9999);
  }
}

TEST_CASE("a submerged body weighs less by the displaced fluid, and a body above it has its whole weight") {
  EffectsWorld scene({earth(), fx::Buoyancy{1000, 0}}, kLongStep);
  const dBodyID under = scene.add_body({0.1, 0.1, 0.1}, 6, 4000, {0, 0, -1});
  const dBodyID above = scene.add_ball(0.1, 4000, {1, 0, 5});
  scene.step();
  CHECK(dBodyGetLinearVel(under)[2] == relative(-0.75 * kGravity * kLongStep).epsilon(1e-6));
  CHECK(dBodyGetLinearVel(above)[2] == relative(-kGravity * kLongStep).epsilon(1e-6));
}

TEST_CASE("without gravity a fluid does not lift") {
  EffectsWorld scene({fx::Gravity{{0, 0, 0}}, fx::Buoyancy{1000, 0}}, kLongStep);
  const dBodyID under = scene.add_body({0.1, 0.1, 0.1}, 6, 400, {0, 0, -1});
  scene.step();
  CHECK(norm(to_vec(dBodyGetLinearVel(under))) == 0);
}

TEST_CASE("damped velocities decay exponentially at any step") {
  for (const double step : {1e-3, 0.05}) {
    EffectsWorld scene({fx::Damping{2, 3}}, step);
    const dBodyID ball = scene.add_ball(0.1, 1000, {0, 0, 0});
    dBodySetLinearVel(ball, 1, 0, 0);
    dBodySetAngularVel(ball, 0, 1, 0);
    scene.run_until(1 - 0.5 * step);
    CHECK(dBodyGetLinearVel(ball)[0] == relative(std::exp(-2)).epsilon(within_rounding(1e-6, 100)));
    CHECK(dBodyGetAngularVel(ball)[1] == relative(std::exp(-3)).epsilon(within_rounding(1e-6, 100)));
  }
}

TEST_CASE("adhesion holds against a pull below the pull-off force and not above") {
  const double pull_off = 5;
  struct Sticky {
    double exponent;
    fx::Effect contact;  ///< another effect of the contact
  };
  for (const Sticky& sticky : {Sticky{2, fx::Friction{0.5, {}}}, Sticky{20, fx::Friction{0.5, {}}},
                               Sticky{60, fx::Friction{0.5, {}}}, Sticky{2, fx::Compliance{1e4, 60, {}}}}) {
    for (const double part : {0.97, 1.03}) {
      // Rounding decides how a flat body lies when it is almost pulled off. If it starts a nanometre higher, it lies differently.
      for (int start = -5; start <= 5; ++start) {
        CAPTURE(sticky.exponent);
        CAPTURE(part);
        CAPTURE(start);
        OnPlane scene({earth(), fx::Adhesion{pull_off, {}}, sticky.contact}, kLongStep);
        const auto e = dReal(sticky.exponent);
        const dGeomID geom = snCreateSuperellipsoid(scene.world.space(), dReal(0.02), dReal(0.02), dReal(0.02), e, e);
        const dBodyID body = scene.add(geom, 1000, {0, 0, 0.02 + 1e-9 * start});
        scene.run_until(0.5);
        double pull = 0;  // the pull grows slowly, because a spring under a sudden load overshoots
        scene.run_until(1, [&] {
          pull = std::min(pull + 0.01 * part * pull_off, mass_of(body) * kGravity + part * pull_off);
          dBodyAddForce(body, 0, 0, dReal(pull));
          return false;
        });
        CHECK((dBodyGetPosition(body)[2] > 0.021) == (part > 1));
      }
    }
  }
}

TEST_CASE("adhesion adds to the normal force of friction") {
  // The body sticks to a wall. Its weight hangs on mu times the adhesion.
  for (const double part : {0.95, 1.05}) {
    OnPlane scene({fx::Friction{0.5, {}}, fx::Adhesion{4, {}}}, kLongStep);
    const dBodyID body = scene.add_body({0.02, 0.02, 0.02}, 20, 1000, {0, 0, 0.02});
    scene.run_until(0.1);
    scene.run_until(0.5, [&] {
      dBodyAddForceAtRelPos(body, dReal(part * 0.5 * 4), 0, 0, 0, 0, dReal(-0.02));
      return false;
    });
    CHECK((dBodyGetPosition(body)[0] > 1e-3) == (part > 1));
  }
}

TEST_CASE("adhesion pulls both bodies: two that stick together gain no momentum") {
  EffectsWorld scene({fx::Adhesion{5, {}}}, kLongStep);
  const std::vector<dBodyID> balls = {scene.add_ball(kRadius, kDensity, {0, 0, 0}),
                                      scene.add_ball(kRadius, 2 * kDensity, {0, 0, 1.999 * kRadius})};
  scene.run_until(0.1);
  CHECK(scene.depth > 0);
  CHECK(std::abs(sum_of(balls, [](dBodyID ball) { return mass_of(ball) * dBodyGetLinearVel(ball)[2]; })) < 1e-5);  // N s; pull: 0.5
}
