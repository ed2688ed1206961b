// Tests of friction, of resistance to rolling and spinning, whose coefficients are lengths, and of contacts whose bodies differ
// from those of their geoms: moving walls and surfaces.
#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "effects/effects_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

constexpr double kSpeed = 1;  // m/s
constexpr double kHeight = 0.02;

/// Adds a puck that slides flat: it neither tips nor rolls.
dBodyID add_puck(EffectsWorld& scene) { return scene.add_body({0.1, 0.1, kHeight}, 20, 1000, {0, 0, kHeight}); }

/// Lets the puck lie, then pushes it in a direction, and returns its position when it has stopped.
Vec slide(EffectsWorld& scene, dBodyID puck, double angle) {
  for (int i = 0; i < 100; ++i) scene.step();
  const Vec start = to_vec(dBodyGetPosition(puck));
  dBodySetLinearVel(puck, dReal(kSpeed * std::cos(angle)), dReal(kSpeed * std::sin(angle)), 0);
  scene.run_until(2, [&] { return norm(to_vec(dBodyGetLinearVel(puck))) < 1e-5; });
  return to_vec(dBodyGetPosition(puck)) - start;
}

double heading_of(const Vec& way) { return std::atan2(way[1], way[0]); }

double excess_of_cone(const EffectsWorld& scene, double coefficient) {
  double worst = -1e300;
  for (const Load& load : scene.loads) {
    const double normal = dot(load.force, load.normal);
    const double tangential = norm(load.force - normal * load.normal);
    worst = std::max(worst, tangential - coefficient * normal);
  }
  return worst;
}

/// Gives the plane z = 0, which stays in place, the velocity of a kinematic body.
dBodyID add_belt(EffectsWorld& scene, const Vec& velocity, const Vec& spin = {0, 0, 0}) {
  const dBodyID belt = dBodyCreate(scene.id());
  dBodySetKinematic(belt);
  dBodySetLinearVel(belt, dReal(velocity[0]), dReal(velocity[1]), dReal(velocity[2]));
  dBodySetAngularVel(belt, dReal(spin[0]), dReal(spin[1]), dReal(spin[2]));
  scene.other_body[dCreatePlane(scene.world.space(), 0, 0, 1, 0)] = belt;
  return belt;
}

/// The body moves with its velocity. The belt's surface stays in place.
void step(EffectsWorld& scene, dBodyID belt) {
  scene.step();
  dBodySetPosition(belt, 0, 0, 0);
}

/// The velocity of a ball after it has hit a plane that moves towards it.
double rebound(const std::vector<fx::Effect>& effects, double approach, double rise) {
  EffectsWorld scene(effects, kStep / 10);
  const dBodyID wall = add_belt(scene, {0, 0, rise});
  const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius + 1e-3});
  dBodySetLinearVel(ball, 0, 0, dReal(-approach));
  for (int i = 0; i < 2000; ++i) {
    scene.step();
    dGeomPlaneSetParams(scene.other_body.begin()->first, 0, 0, 1, dBodyGetPosition(wall)[2]);
  }
  return dBodyGetLinearVel(ball)[2];
}

}  // namespace

TEST_CASE("a puck slides straight by v^2 / (2 mu g) in every direction") {
  for (const double coefficient : {0.1, 0.5}) {
    for (const double angle : {0.0, 0.4, 45 * kDegree, 2.0}) {
      CAPTURE(coefficient);
      CAPTURE(angle);
      OnPlane scene({earth(), fx::Friction{coefficient, {}}}, kStep);
      const Vec way = slide(scene, add_puck(scene), angle);
      CHECK(std::hypot(way[0], way[1]) == relative(kSpeed * kSpeed / (2 * coefficient * kGravity)).epsilon(0.01));
      CHECK(std::abs(std::remainder(heading_of(way) - angle, 2 * std::numbers::pi)) < 0.02);
    }
  }
}

TEST_CASE("on an incline a puck stays up to the angle of friction and slides above it") {
  const double coefficient = 0.5;
  const double limit = std::atan(coefficient);
  for (const double beyond : {-0.3 * kDegree, 0.3 * kDegree}) {
    for (const double turn : {0.0, 30 * kDegree}) {
      CAPTURE(beyond);
      const double angle = limit + beyond;
      // Gravity is tilted instead of the plane, so the incline can have any direction.
      const double across = kGravity * std::sin(angle);
      const fx::Gravity leaning{{across * std::cos(turn), across * std::sin(turn), -kGravity * std::cos(angle)}};
      OnPlane scene({leaning, fx::Friction{coefficient, {}}}, kStep);
      const dBodyID puck = add_puck(scene);
      scene.run_until(1);
      const double speed = norm(to_vec(dBodyGetLinearVel(puck)));
      if (beyond < 0) {
        CHECK(speed < 1e-3);
      } else {
        const double acceleration = across - coefficient * kGravity * std::cos(angle);
        CHECK(speed == relative(acceleration).epsilon(0.05));
      }
    }
  }
}

TEST_CASE("no friction force exceeds Coulomb's cone") {
  // Quickstep takes the limits from its last iteration but one, so they hold as well as it converges. The distribution of a face's
  // load over four contacts is not determined, so it converges more slowly than for one contact, at any number of iterations.
  struct Case {
    double exponent;
    double tolerance;  // relative to the largest load
  };
  for (const Case& c : {Case{4, 1e-6}, Case{8, 1e-5}}) {
    CAPTURE(c.exponent);
    const double coefficient = 0.4;
    OnPlane scene({earth(), fx::Friction{coefficient, {}}}, kStep);
    dWorldSetQuickStepNumIterations(scene.id(), 400);
    Random random(5);
    for (int i = 0; i < 8; ++i) {
      const dGeomID geom =
          snCreateSuperellipsoid(scene.world.space(), dReal(0.1), dReal(0.07), dReal(0.05), 3, dReal(i % 2 == 0 ? 2 : c.exponent));
      random.turn(geom);
      const dBodyID body = scene.add(geom, 1000, {0.12 * (i % 3), 0.1 * (i / 3 % 2), 0.15 + 0.12 * i});
      const Vec v = 2.0 * random.direction();
      dBodySetLinearVel(body, dReal(v[0]), dReal(v[1]), 0);
    }
    double worst = -1e300;
    double weight = 0;
    for (int i = 0; i < 1500; ++i) {
      scene.step();
      worst = std::max(worst, excess_of_cone(scene, coefficient));
      for (const Load& load : scene.loads) weight = std::max(weight, norm(load.force));
    }
    CHECK(weight > 0);
    CHECK(worst < c.tolerance * weight);
  }
}

TEST_CASE("materials combine by the geometric mean, unless the pair is listed") {
  struct Case {
    std::vector<fx::Effect> list;
    double expected;
  };
  const fx::Friction all{0.8, {}};
  const std::vector<Case> cases = {
      {{earth(), fx::Friction{0.2, fx::MaterialSelector::of(1)}, fx::Friction{0.45, fx::MaterialSelector::of(2)}}, 0.3},
      {{earth(), all, fx::Friction{0.2, fx::MaterialSelector::of(1)}}, 0.4},
      {{earth(), all, fx::Friction{0.25, fx::MaterialSelector::between(2, 1)}}, 0.25},
      {{earth(), fx::Friction{0.2, fx::MaterialSelector::of(1)}}, 0},
  };
  for (const Case& c : cases) {
    OnPlane scene(c.list, kStep);
    scene.material_of = [](dGeomID geom) { return dGeomGetBody(geom) != nullptr ? 1 : 2; };
    const dBodyID puck = add_puck(scene);
    scene.run_until(0.05);
    dBodySetLinearVel(puck, dReal(kSpeed), 0, 0);
    const double time = 0.1;
    scene.run_until(time);
    CHECK(dBodyGetLinearVel(puck)[0] == relative(kSpeed - c.expected * kGravity * time).epsilon(5e-3));
  }
}

TEST_CASE("anisotropic friction of one side acts whichever side it is, and of both the lower material's") {
  const auto of = [](double coefficient, int material) {
    return fx::AnisotropicFriction{coefficient, coefficient, {1, 0, 0}, fx::MaterialSelector::of(material)};
  };
  for (const bool puck_is_lower : {true, false}) {
    for (const auto& [list, expected] : std::vector<std::pair<std::vector<fx::Effect>, double>>{
             {{earth(), of(0.3, 1)}, 0.3}, {{earth(), of(0.3, 2)}, 0.3}, {{earth(), of(0.2, 1), of(0.4, 2)}, 0.2}}) {
      OnPlane scene(list, kStep);
      scene.material_of = [&](dGeomID geom) { return (dGeomGetBody(geom) != nullptr) == puck_is_lower ? 1 : 2; };
      const dBodyID puck = add_puck(scene);
      scene.run_until(0.05);
      dBodySetLinearVel(puck, dReal(kSpeed), 0, 0);
      scene.run_until(0.1);
      CHECK(dBodyGetLinearVel(puck)[0] == relative(kSpeed - expected * kGravity * 0.1).epsilon(0.01));
    }
  }
}

TEST_CASE("anisotropic friction has its coefficient along each axis, and the most dissipating force in between") {
  const double along = 0.1;
  const double across = 0.4;
  const fx::AnisotropicFriction grain{along, across, {1, 1, 0}, {}};
  for (const double turn : {0.0, 0.7}) {  // angle of the puck and of its axes of friction
    CAPTURE(turn);
    OnPlane scene({earth(), grain}, kStep);
    dWorldSetQuickStepNumIterations(scene.id(), 200);  // the loads of four contacts of one face are redundant
    const dBodyID puck = add_puck(scene);
    const double axes_angle = 45 * kDegree + turn;
    const auto decelerate = [&](double angle) {
      dBodySetPosition(puck, 0, 0, dReal(kHeight));
      dBodySetAngularVel(puck, 0, 0, 0);
      supernormal::test::turn(puck, {0, 0, 1}, turn);
      dBodySetLinearVel(puck, 0, 0, 0);
      for (int i = 0; i < 60; ++i) scene.step();
      dBodySetLinearVel(puck, dReal(kSpeed * std::cos(angle)), dReal(kSpeed * std::sin(angle)), 0);
      const Vec before = to_vec(dBodyGetLinearVel(puck));
      for (int i = 0; i < 40; ++i) scene.step();
      return (-1 / (40 * kStep * kGravity)) * (to_vec(dBodyGetLinearVel(puck)) - before);
    };
    // The force is 0.5 % less than the ellipse on its axes, because the rectangle keeps a tenth of the other side.
    CHECK(norm(decelerate(axes_angle)) == relative(along).epsilon(0.01));
    CHECK(norm(decelerate(axes_angle + 90 * kDegree)) == relative(across).epsilon(0.01));
    const Vec force = decelerate(axes_angle + 45 * kDegree);
    const double root = std::hypot(along, across);
    const Vec axis = {std::cos(axes_angle), std::sin(axes_angle), 0};
    const Vec normal = {-std::sin(axes_angle), std::cos(axes_angle), 0};
    CHECK(dot(force, axis) == relative(along * along / root).epsilon(0.05));
    CHECK(dot(force, normal) == relative(across * across / root).epsilon(0.01));
  }
}

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

TEST_CASE("a puck on a belt has its velocity after v / (mu g), and a wall without velocity does not carry it") {
  constexpr double kSpeed = 0.5;
  for (const double mu : {0.2, 0.5}) {
    EffectsWorld scene({earth(), fx::Friction{mu, {}}}, kStep);
    const dBodyID belt = add_belt(scene, {kSpeed, 0, 0});
    const dBodyID puck = scene.add_body({0.1, 0.1, 0.02}, 20, 1000, {0, 0, 0.02});
    double time = 0;
    while (dBodyGetLinearVel(puck)[0] < 0.999 * kSpeed && time < 2) {
      step(scene, belt);
      time += kStep;
    }
    CHECK(time == relative(kSpeed / (mu * kGravity)).epsilon(0.01));
    for (int i = 0; i < 500; ++i) step(scene, belt);
    CHECK(double{dBodyGetLinearVel(puck)[0]} == relative(kSpeed).epsilon(1e-3));
  }
}

TEST_CASE("a ball on a belt ends rolling at 2/7 of the belt's velocity") {
  for (const double length : {kStep, 1e-3, 1e-2, 5e-2}) {  // s; the long steps with contacts before overlap
    CAPTURE(length);
    std::vector<fx::Effect> list = {earth(), fx::Friction{0.3, {}}};
    if (length > kStep) list.emplace_back(fx::SpeculativeContacts{});
    EffectsWorld scene(list, length);
    const dBodyID belt = add_belt(scene, {0, 0.7, 0});
    const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
    for (int i = 0; i < 2000; ++i) step(scene, belt);
    CHECK(double{dBodyGetLinearVel(ball)[1]} == relative(2.0 / 7 * 0.7).epsilon(1e-3));
    CHECK(double{dBodyGetAngularVel(ball)[0]} == relative((0.7 - 0.2) / kBallRadius).epsilon(1e-3));
    CHECK(double{dBodyGetPosition(ball)[2]} == relative(kBallRadius).epsilon(1e-3));
  }
}

TEST_CASE("spinning resistance sets a ball at the axis of a turntable spinning") {
  EffectsWorld scene({earth(), fx::Friction{0.3, {}}, fx::RollingResistance{0, 1e-3, {}}}, kStep);
  const dBodyID table = add_belt(scene, {0, 0, 0}, {0, 0, 3});
  const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, kBallRadius});
  // The torque is 1e-3 m times the weight, and the moment of inertia 2/5 m r^2.
  const double time = 3 * 0.4 * kBallRadius * kBallRadius / (1e-3 * kGravity);
  const int half = static_cast<int>(0.5 * time / kStep);
  for (int i = 0; i < half; ++i) step(scene, table);
  CHECK(double{dBodyGetAngularVel(ball)[2]} == relative(1.5).epsilon(0.02));
  for (int i = 0; i < 2 * half; ++i) step(scene, table);
  CHECK(double{dBodyGetAngularVel(ball)[2]} == relative(3).epsilon(1e-3));
}

TEST_CASE("restitution applies to the velocity relative to the wall") {
  constexpr double kApproach = 0.4;
  constexpr double kRise = 0.3;
  const double bounce = kRise + 0.6 * (kApproach + kRise);
  CHECK(rebound({fx::Restitution{0.6, 0, {}}}, kApproach, kRise) == relative(bounce).epsilon(1e-5));
  CHECK(rebound({fx::Hertz{1e7, 0.3, 0.6, {}}}, kApproach, kRise) == relative(bounce).epsilon(0.01));
  const double mass = 4.0 / 3 * std::numbers::pi * std::pow(kBallRadius, 3) * 1000;
  CHECK(rebound({fx::Compliance{1e4 * mass, 0, {}}}, kApproach, kRise) == relative(kRise + kApproach + kRise).epsilon(0.01));
}

TEST_CASE("sides with the bodies of the geoms give the same contacts as materials alone") {
  EffectsWorld scene({earth(), fx::Friction{0.3, {}}, fx::RollingResistance{1e-3, 1e-3, {}}, fx::Hertz{1e7, 0.3, 0.6, {}}}, kStep);
  const dBodyID ball = scene.add_ball(kBallRadius, 1000, {0, 0, 0});
  const dBodyID other = scene.add_ball(kBallRadius, 1000, {0.06, 0.07, 0});
  dBodySetLinearVel(ball, 1, dReal(0.3), 0);
  dBodySetAngularVel(other, 1, 2, 3);
  std::array<dContact, 1> a{};
  REQUIRE(dCollide(dBodyGetFirstGeom(ball), dBodyGetFirstGeom(other), 1, &a[0].geom, sizeof(dContact)) == 1);
  std::array<dContact, 1> b = a, c = a;
  CHECK(scene.effects.set_up_contacts(a) == 1);
  CHECK(scene.effects.set_up_contacts(b, {0, dGeomGetBody(b[0].geom.g1)}, {0, dGeomGetBody(b[0].geom.g2)}) == 1);
  CHECK(a[0].surface.motionN == b[0].surface.motionN);
  CHECK(a[0].surface.rho == b[0].surface.rho);
  CHECK(std::equal(a[0].fdir1, a[0].fdir1 + 3, b[0].fdir1));
  // So does a velocity that both have besides.
  dBodySetLinearVel(ball, 3, dReal(-0.7), 2);
  dBodySetLinearVel(other, 2, -1, 2);
  CHECK(scene.effects.set_up_contacts(c) == 1);
  for (int i = 0; i < 3; ++i) CHECK(std::abs(a[0].fdir1[i] - c[0].fdir1[i]) < 1e-6);
}
