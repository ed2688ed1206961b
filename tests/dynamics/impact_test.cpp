// Impacts. The impulse acts along the exact normal, through the exact contact point.
#include <doctest/doctest.h>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

void make_elastic(World& world) {
  world.surface.mode = dContactBounce;
  world.surface.bounce = 1;
  dWorldSetGravity(world.id(), 0, 0, 0);
  dWorldSetCFM(world.id(), 0);
  dWorldSetQuickStepNumIterations(world.id(), 60);  // converges to rounding
  dWorldSetERP(world.id(), 0);                      // only the bounce, without a push out of the overlap
}

struct Totals {
  Vec linear{}, angular{};  ///< kg m/s, kg m^2/s about the world's origin
  double energy = 0;        ///< J
};

/// The poses are arguments, because a step first changes velocities and then moves the bodies. Its impulse acts at the poses before
/// the step.
Totals totals(const std::array<dBodyID, 2>& bodies) {
  Totals sum;
  for (const dBodyID body : bodies) {
    const Vec p = mass_of(body) * to_vec(dBodyGetLinearVel(body));
    const Vec x = to_vec(dBodyGetPosition(body));
    sum.linear = sum.linear + p;
    sum.angular =
        sum.angular + spin_momentum(body) + Vec{x[1] * p[2] - x[2] * p[1], x[2] * p[0] - x[0] * p[2], x[0] * p[1] - x[1] * p[0]};
    sum.energy += kinetic_energy(body);
  }
  return sum;
}

struct Pose {
  Vec position;
  std::array<dReal, 4> quaternion;
};

Pose pose_of(dBodyID body) {
  const dReal* const q = dBodyGetQuaternion(body);
  return {to_vec(dBodyGetPosition(body)), {q[0], q[1], q[2], q[3]}};
}

void set_pose(dBodyID body, const Pose& pose) {
  dBodySetPosition(body, dReal(pose.position[0]), dReal(pose.position[1]), dReal(pose.position[2]));
  dBodySetQuaternion(body, pose.quaternion.data());
}

/// Places body 2 where it overlaps body 1 by a thousandth, and moves both towards each other.
void bring_together(Random& random, dGeomID geom1, dGeomID geom2) {
  for (const dGeomID geom : {geom1, geom2}) {
    random.turn(geom);
    const dBodyID body = dGeomGetBody(geom);
    const Vec w = random.uniform(0, 3) * random.direction();
    dBodySetAngularVel(body, dReal(w[0]), dReal(w[1]), dReal(w[2]));
    dBodySetGyroscopicMode(body, 0);  // only the impulse acts
  }
  const Vec direction = random.direction();
  place(geom1, {0, 0, 0});
  place(geom2, 4.0 * direction);
  snProximity proximity;
  for (int i = 0; i < 20; ++i) {  // finds the distance by Newton's method
    REQUIRE(snGeomProximity(geom1, geom2, &proximity) == 1);
    move(geom2, -(proximity.gap + 1e-3) / dot(to_vec(proximity.normal), direction) * direction);
  }
  const Vec v = 2.0 * to_vec(proximity.normal) + 0.3 * random.direction();
  dBodySetLinearVel(dGeomGetBody(geom1), dReal(v[0]), dReal(v[1]), dReal(v[2]));
}

}  // namespace

TEST_CASE("a frictionless elastic drop on a plane at 1 m/s has the published velocities") {
  // tests/data/README.md: "tilted about y: (0.5,0.3,0.25; 2,2) at 15 deg: v_z after 0.3620502923 m/s, |omega| 3.7286342504 rad/s;
  // (0.5,0.3,0.25; 4,4) at 15 deg: -0.0222325084, 3.4155393160." Without gravity the body does not rotate in flight, so this holds
  // for any time step and depth.
  struct Case {
    double exponent;
    double v_z, spin;
  };
  for (const Case& c : {Case{2, 0.3620502923, 3.7286342504}, Case{4, -0.0222325084, 3.4155393160}}) {
    for (const double dt : {1e-5, 1e-3}) {
      CAPTURE(c.exponent);
      CAPTURE(dt);
      OdeSession session;
      World world;
      make_elastic(world);
      world.add_plane();
      const dGeomID geom =
          snCreateSuperellipsoid(world.space(), dReal(0.5), dReal(0.3), dReal(0.25), dReal(c.exponent), dReal(c.exponent));
      const dBodyID body = world.add(geom, 1000);
      turn(body, {0, 1, 0}, 15 * kDegree);
      dBodySetPosition(body, 0, 0, dReal(0.35));
      dBodySetLinearVel(body, 0, 0, -1);
      int steps = 0;
      while (world.contacts == 0 && ++steps < 100000) world.quick_step(dt);
      CHECK(world.contacts >= 1);
      CHECK(dBodyGetLinearVel(body)[2] == relative(c.v_z).epsilon(1e-8));
      CHECK(norm(to_vec(dBodyGetAngularVel(body))) == relative(c.spin).epsilon(1e-8));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "a ball that looks ahead and hits at 45 degrees slides or rolls on by its closed form, in any step") {
  // Friction takes mu v of the velocity along the floor, but no more than makes the ball roll: 2/7 v. It gives 5/2 of this as w r.
  constexpr double kStep = 0.01;    // s
  constexpr double kRadius = 0.05;  // m
  for (const bool is_on_box : {false, true}) {
    for (const double mu : {0.2, 1.0}) {
      for (const double radii : {0.1, 0.5, 3.0, 50.0}) {
        CAPTURE(is_on_box);
        CAPTURE(mu);
        CAPTURE(radii);
        World world;
        dWorldSetGravity(world.id(), 0, 0, 0);
        world.set_friction(mu);
        if (is_on_box) place(dCreateBox(world.space(), 1000, 1000, 1), {0, 0, -0.5});
        if (!is_on_box) world.add_plane();
        const dGeomID ball = snCreateEllipsoid(world.space(), dReal(kRadius), dReal(kRadius), dReal(kRadius));
        REQUIRE(snGeomSetLookAhead(ball, dReal(kStep)) == 1);
        const dBodyID body = world.add(ball, 1000);
        const double speed = radii * kRadius / kStep;
        dBodySetPosition(body, 0, 0, dReal(kRadius + 1.3 * speed * kStep));
        dBodySetLinearVel(body, dReal(speed), 0, dReal(-speed));
        for (int i = 0; i < 6; ++i) world.quick_step(kStep);
        const double lost = std::min(mu, 2.0 / 7) * speed;
        CHECK(dBodyGetLinearVel(body)[0] == relative(speed - lost).epsilon(1e-3));
        CHECK(dBodyGetAngularVel(body)[1] * kRadius == relative(2.5 * lost).epsilon(1e-3));
        CHECK(dBodyGetPosition(body)[2] == relative(kRadius).epsilon(1e-3));
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "two bodies that collide without friction keep momentum, angular momentum and energy to rounding") {
  World world;
  make_elastic(world);
  Random random(4711);
  for (int pair = 0; pair < 300; ++pair) {
    CAPTURE(pair);
    std::array<dGeomID, 2> geoms{};
    std::array<dBodyID, 2> bodies{};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto half_axis = [&] { return dReal(random.uniform(0.2, 1)); };
      const auto exponent = [&] { return dReal(random.uniform(1.3, 6)); };
      const std::array<dReal, 5> p = {half_axis(), half_axis(), half_axis(), exponent(), exponent()};
      geoms[i] = snCreateSuperellipsoid(world.space(), p[0], p[1], p[2], p[3], p[4]);
      bodies[i] = world.add(geoms[i], 1000);
    }
    bring_together(random, geoms[0], geoms[1]);
    const Totals before = totals(bodies);
    const std::array<Pose, 2> poses = {pose_of(bodies[0]), pose_of(bodies[1])};
    const Vec velocity = to_vec(dBodyGetLinearVel(bodies[1]));
    world.quick_step(1e-3);
    CHECK(world.contacts >= 1);
    CHECK(norm(to_vec(dBodyGetLinearVel(bodies[1])) - velocity) > 0.01);  // the bodies did collide
    for (std::size_t i = 0; i < 2; ++i) set_pose(bodies[i], poses[i]);
    const Totals after = totals(bodies);
    const double scale = norm(before.linear);
    CHECK(norm(after.linear - before.linear) < 1e-13 * scale);
    CHECK(norm(after.angular - before.angular) < 1e-12 * scale);
    if (world.contacts == 1) CHECK(after.energy == relative(before.energy).epsilon(1e-12));
    for (std::size_t i = 0; i < 2; ++i) {
      dGeomDestroy(geoms[i]);
      dBodyDestroy(bodies[i]);
    }
  }
}
