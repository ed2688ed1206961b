// Bodies in a world: they come to rest, gain no energy, and bounce as the closed form says.
#include <doctest/doctest.h>

#include <algorithm>

#include "ode/ode_fixture.hpp"

using namespace supernormal::test;

namespace {

struct World {
  dWorldID id = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  dJointGroupID contacts = dJointGroupCreate(0);
  dReal mu = dReal(0.5);
  dReal bounce = 0;
  double deepest = 0;  // in the last step

  World() { dWorldSetGravity(id, 0, 0, dReal(-9.81)); }
  ~World() {
    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(id);
  }
  World(const World&) = delete;
  World(World&&) = delete;
  World& operator=(const World&) = delete;
  World& operator=(World&&) = delete;

  dBodyID add(dGeomID geom, double density) const {
    const dBodyID body = dBodyCreate(id);
    dMass mass;
    REQUIRE(snMassSet(&mass, dReal(density), geom) == 1);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    return body;
  }

  static void near_callback(void* self, dGeomID o1, dGeomID o2) {
    World& world = *static_cast<World*>(self);
    dContact contact{};
    if (dCollide(o1, o2, 1, &contact.geom, sizeof contact) == 0) return;
    world.deepest = std::max(world.deepest, double{contact.geom.depth});
    contact.surface.mode = dContactApprox1 | (world.bounce > 0 ? dContactBounce : 0);
    contact.surface.mu = world.mu;
    contact.surface.bounce = world.bounce;
    dJointAttach(dJointCreateContact(world.id, world.contacts, &contact), dGeomGetBody(o1), dGeomGetBody(o2));
  }

  void step(double dt, bool quick) {
    deepest = 0;
    dSpaceCollide(space, this, near_callback);
    if (quick) {
      dWorldQuickStep(id, dReal(dt));
    } else {
      dWorldStep(id, dReal(dt));
    }
    dJointGroupEmpty(contacts);
  }
};

double kinetic_energy(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const Vec v = to_vec(dBodyGetLinearVel(body));
  dVector3 spin;
  const dReal* const w = dBodyGetAngularVel(body);
  dBodyVectorFromWorld(body, w[0], w[1], w[2], spin);
  const Vec s = to_vec(spin);
  return 0.5 * (mass.mass * dot(v, v) + mass.I[0] * s[0] * s[0] + mass.I[5] * s[1] * s[1] + mass.I[10] * s[2] * s[2]);
}

double energy(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  return kinetic_energy(body) + mass.mass * 9.81 * dBodyGetPosition(body)[2];
}

}  // namespace

TEST_CASE("superellipsoids dropped on a plane come to rest on it and lose energy only") {
  OdeSession session;
  World world;
  dCreatePlane(world.space, 0, 0, 1, 0);
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
    geoms.push_back(snCreateSuperellipsoid(world.space, c.a, c.b, c.c, c.delta, c.epsilon));
    bodies.push_back(world.add(geoms.back(), 1000));
    dBodySetPosition(bodies.back(), dReal(x += 1), 0, dReal(0.2));
    dMatrix3 R;
    dRFromAxisAndAngle(R, 1, dReal(0.5), 0, dReal(0.3));
    dBodySetRotation(bodies.back(), R);
    dBodySetLinearDampingThreshold(bodies.back(), 0);
    dBodySetAngularDamping(bodies.back(), dReal(0.01));  // rolling does not stop by itself
  }
  const double start = energy(bodies[0]) + energy(bodies[1]) + energy(bodies[2]);
  double highest = start;
  for (int step = 0; step < 5000; ++step) {
    world.step(0.002, true);
    double now = 0;
    for (const dBodyID body : bodies) now += energy(body);
    highest = std::max(highest, now);
  }
  CHECK(highest < start * (1 + 1e-3));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    CAPTURE(i);
    dMass mass;
    dBodyGetMass(bodies[i], &mass);
    CHECK(kinetic_energy(bodies[i]) < 1e-6 * mass.mass);
    CHECK(dBodyGetPosition(bodies[i])[2] == doctest::Approx(cases[i].c).epsilon(5e-3));  // lies flat
  }
  CHECK(world.deepest < 0.02 * 0.05);
}

TEST_CASE("frictionless elastic drop of a tilted ellipsoid: the closed form of shared/reference/README.md") {
  // "Frictionless, elastic drop on a plane at 1 m/s, tilted about y: (0.5,0.3,0.25; 2,2) at 15 deg: v_z after 0.3620502923 m/s,
  // |omega| 3.7286342504 rad/s; (0.5,0.3,0.25; 4,4) at 15 deg: -0.0222325084, 3.4155393160."
  struct Case {
    dReal exponent;
    double v_z, spin;
  };
  for (const Case& c : {Case{2, 0.3620502923, 3.7286342504}, Case{4, -0.0222325084, 3.4155393160}}) {
    CAPTURE(c.exponent);
    OdeSession session;
    World world;
    world.mu = 0;
    world.bounce = 1;
    dWorldSetGravity(world.id, 0, 0, 0);
    dWorldSetERP(world.id, 0);  // no push out: the impulse alone
    dWorldSetCFM(world.id, 0);
    dCreatePlane(world.space, 0, 0, 1, 0);
    const dGeomID geom = snCreateSuperellipsoid(world.space, dReal(0.5), dReal(0.3), dReal(0.25), c.exponent, c.exponent);
    const dBodyID body = world.add(geom, 1000);
    dMatrix3 R;
    dRFromAxisAndAngle(R, 0, 1, 0, dReal(std::acos(-1.0) / 12));
    dBodySetRotation(body, R);
    // Touching: the lowest point is 1e-9 m below the plane.
    const dVector3 down = {0, 0, -1, 0};
    dVector3 lowest;
    REQUIRE(snGeomSupport(geom, down, lowest) == 1);
    dBodySetPosition(body, 0, 0, dReal(-lowest[2] - 1e-9));
    dBodySetLinearVel(body, 0, 0, -1);
    world.step(1e-7, false);  // the closed form is of an instant
    CHECK(dBodyGetLinearVel(body)[2] == doctest::Approx(c.v_z).epsilon(1e-6));
    CHECK(norm(to_vec(dBodyGetAngularVel(body))) == doctest::Approx(c.spin).epsilon(1e-6));
  }
}

TEST_CASE("two bodies collide head on, without gravity: momentum and energy are kept") {
  OdeSession session;
  World world;
  world.mu = 0;
  world.bounce = 1;
  dWorldSetGravity(world.id, 0, 0, 0);
  const dBodyID body1 = world.add(snCreateSuperellipsoid(world.space, dReal(0.5), dReal(0.3), dReal(0.25), 4, 3), 1000);
  const dBodyID body2 = world.add(snCreateEllipsoid(world.space, dReal(0.2), dReal(0.3), dReal(0.4)), 2000);
  dBodySetPosition(body2, dReal(1.2), dReal(0.1), dReal(0.05));
  dBodySetLinearVel(body1, 1, 0, 0);
  const auto momentum = [&] {
    Vec sum{};
    for (const dBodyID body : {body1, body2}) {
      dMass mass;
      dBodyGetMass(body, &mass);
      sum = sum + double{mass.mass} * to_vec(dBodyGetLinearVel(body));
    }
    return sum;
  };
  const Vec momentum_before = momentum();
  const double energy_before = kinetic_energy(body1) + kinetic_energy(body2);
  int contact_steps = 0;
  for (int step = 0; step < 20000; ++step) {
    world.step(1e-4, false);
    contact_steps += world.deepest > 0 ? 1 : 0;
  }
  CHECK(contact_steps > 0);
  CHECK(dBodyGetLinearVel(body2)[0] > 0.1);
  CHECK(norm(momentum() - momentum_before) < 1e-9 * norm(momentum_before));
  CHECK(kinetic_energy(body1) + kinetic_energy(body2) == doctest::Approx(energy_before).epsilon(1e-3));
}
