// Tests of bodies in a world. They come to rest, gain no energy, and bounce as in the closed form.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

/// Removes friction and gravity.
void make_elastic(World& world) {
  world.surface.mode = dContactApprox1 | dContactBounce;
  world.surface.bounce = 1;
  dWorldSetGravity(world.id(), 0, 0, 0);
}

}  // namespace

TEST_CASE("superellipsoids dropped on a plane come to rest and only lose energy") {
  OdeSession session;
  World world;
  world.room = 1;
  world.surface.mode = dContactApprox1;
  world.surface.mu = dReal(0.5);
  world.add_plane();
  struct Case {
    dReal a, b, c, delta, epsilon;
  };
  const std::array<Case, 3> cases = {{{dReal(0.1), dReal(0.1), dReal(0.06), 2, 2},
                                      {dReal(0.1), dReal(0.08), dReal(0.05), dReal(2.5), dReal(2.5)},
                                      {dReal(0.08), dReal(0.08), dReal(0.05), 2, 3}}};
  std::vector<dBodyID> bodies;
  std::vector<dGeomID> geoms;
  double x = 0;
  for (const Case& c : cases) {
    geoms.push_back(snCreateSuperellipsoid(world.space(), c.a, c.b, c.c, c.delta, c.epsilon));
    bodies.push_back(world.add(geoms.back(), 1000));
    dBodySetPosition(bodies.back(), dReal(x += 1), 0, dReal(0.2));
    turn(bodies.back(), {1, 0.5, 0}, 0.3);
    dBodySetLinearDampingThreshold(bodies.back(), 0);
    dBodySetAngularDamping(bodies.back(), dReal(0.01));  // rolling does not stop by itself
  }
  const double start = energy(bodies[0]) + energy(bodies[1]) + energy(bodies[2]);
  double highest = start;
  for (int step = 0; step < 5000; ++step) {
    world.quick_step(0.002);
    double now = 0;
    for (const dBodyID body : bodies) now += energy(body);
    highest = std::max(highest, now);
  }
  CHECK(highest < start * (1 + 1e-3));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    CAPTURE(i);
    CHECK(kinetic_energy(bodies[i]) < 1e-6 * mass_of(bodies[i]));
    CHECK(dBodyGetPosition(bodies[i])[2] == relative(cases[i].c).epsilon(5e-3));  // the body lies flat
  }
  CHECK(world.depth < 0.02 * 0.05);
}

TEST_CASE("a frictionless elastic drop of a tilted ellipsoid has the velocities of tests/data/README.md") {
  // tests/data/README.md: "Frictionless, elastic drop on a plane at 1 m/s, tilted about y: (0.5,0.3,0.25; 2,2) at 15 deg: v_z
  // after 0.3620502923 m/s, |omega| 3.7286342504 rad/s; (0.5,0.3,0.25; 4,4) at 15 deg: -0.0222325084, 3.4155393160."
  struct Case {
    dReal exponent;
    double v_z, spin;
  };
  for (const Case& c : {Case{2, 0.3620502923, 3.7286342504}, Case{4, -0.0222325084, 3.4155393160}}) {
    CAPTURE(c.exponent);
    OdeSession session;
    World world;
    world.room = 1;
    make_elastic(world);
    dWorldSetERP(world.id(), 0);  // no push out of the overlap: only the impulse acts
    dWorldSetCFM(world.id(), 0);
    world.add_plane();
    const dGeomID geom = snCreateSuperellipsoid(world.space(), dReal(0.5), dReal(0.3), dReal(0.25), c.exponent, c.exponent);
    const dBodyID body = world.add(geom, 1000);
    turn(body, {0, 1, 0}, 15 * kDegree);
    // The body touches: its lowest point is 1e-9 m below the plane.
    const dVector3 down = {0, 0, -1, 0};
    dVector3 lowest;
    REQUIRE(snGeomSupport(geom, down, lowest) == 1);
    dBodySetPosition(body, 0, 0, dReal(-lowest[2] - within_rounding(1e-9)));
    dBodySetLinearVel(body, 0, 0, -1);
    world.exact_step(1e-7);  // the closed form is for an instantaneous impact
    CHECK(dBodyGetLinearVel(body)[2] == relative(c.v_z).epsilon(within_rounding(1e-6, 50)));
    CHECK(norm(to_vec(dBodyGetAngularVel(body))) == relative(c.spin).epsilon(within_rounding(1e-6)));
  }
}

TEST_CASE("two bodies that collide head on keep momentum and energy") {
  OdeSession session;
  World world;
  world.room = 1;
  make_elastic(world);
  dWorldSetCFM(world.id(),
               dReal(1e-10));  // ODE's default in double precision; the default in single precision, 1e-5, is too soft here
  const dBodyID body1 = world.add(snCreateSuperellipsoid(world.space(), dReal(0.5), dReal(0.3), dReal(0.25), 4, 3), 1000);
  const dBodyID body2 = world.add(snCreateEllipsoid(world.space(), dReal(0.2), dReal(0.3), dReal(0.4)), 2000);
  dBodySetPosition(body2, dReal(1.2), dReal(0.1), dReal(0.05));
  dBodySetLinearVel(body1, 1, 0, 0);
  const auto momentum = [&] {
    Vec sum{};
    for (const dBodyID body : {body1, body2}) sum = sum + mass_of(body) * to_vec(dBodyGetLinearVel(body));
    return sum;
  };
  const Vec momentum_before = momentum();
  const double energy_before = kinetic_energy(body1) + kinetic_energy(body2);
  int contact_steps = 0;
  for (int step = 0; step < 20000; ++step) {
    world.exact_step(1e-4);
    contact_steps += world.depth > 0 ? 1 : 0;
  }
  CHECK(contact_steps > 0);
  CHECK(dBodyGetLinearVel(body2)[0] > 0.1);
  CHECK(norm(momentum() - momentum_before) < within_rounding(1e-9) * norm(momentum_before));
  CHECK(kinetic_energy(body1) + kinetic_energy(body2) == relative(energy_before).epsilon(1e-3));
}
