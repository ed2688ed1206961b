// Bodies on heightfields in a running world. None may fall through.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "ode/terrain.hpp"
#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

/// Sets up a rough world in which y is up.
void set_up(World& world) {
  dWorldSetGravity(world.id(), 0, dReal(-kGravity), 0);
  world.surface.mode = dContactApprox1;
  world.surface.mu = dReal(0.5);
}

dBodyID add(const World& world, dGeomID geom) {
  dMass mass;
  dMassSetSphereTotal(&mass, 1, dReal(0.1));  // the same mass for a dSphere
  return world.add(geom, mass);
}

/// The smallest height of the body's middle above the surface while it falls from `start` for two seconds, as long as it is over
/// the heightfield.
double lowest_height(dGeomID (*create)(dSpaceID space), const Terrain& terrain, const Vec& start) {
  World world;
  set_up(world);
  terrain.create(false, world.space());
  const dBodyID body = add(world, create(world.space()));
  dBodySetPosition(body, dReal(start[0]), dReal(start[1]), dReal(start[2]));
  double lowest = start[1];
  for (int step = 0; step < 1000; ++step) {
    world.quick_step(0.002);
    const Vec p = to_vec(dBodyGetPosition(body));
    if (std::abs(p[0]) > 0.49 * terrain.layout().width || std::abs(p[2]) > 0.49 * terrain.layout().depth) break;
    lowest = std::min(lowest, p[1] - terrain.surface(p[0], p[2]));
  }
  return lowest;
}

dGeomID create_ode_sphere(dSpaceID space) { return dCreateSphere(space, dReal(0.1)); }
dGeomID create_our_sphere(dSpaceID space) { return snCreateEllipsoid(space, dReal(0.1), dReal(0.1), dReal(0.1)); }
dGeomID create_brick(dSpaceID space) { return snCreateSuperellipsoid(space, dReal(0.1), dReal(0.07), dReal(0.05), 8, 8); }
dGeomID create_egg(dSpaceID space) { return snCreateEllipsoid(space, dReal(0.08), dReal(0.1), dReal(0.05)); }

}  // namespace

TEST_CASE("small bodies dropped on ridges and peaks stay above, where dSphere does not") {
  const OdeSession session;
  const Terrain ridge({9, 9, 8, 8}, [](int i, int /*j*/) { return 2.0 - 0.8 * std::abs(i - 4); });
  const Terrain peak({9, 9, 8, 8}, [](int i, int j) { return i == 4 && j == 4 ? 1.5 : 0.0; });
  const Terrain diagonal({9, 9, 8, 8}, [](int i, int j) { return -0.7 * std::abs(i + j - 8); });
  struct Case {
    const Terrain& terrain;
    Vec top;
  };
  const std::array<Case, 3> cases = {{{ridge, {0, 2, 0.3}}, {peak, {0, 1.5, 0}}, {diagonal, {0.5, 0, -0.5}}}};
  for (const Case& c : cases) {
    const Vec start = c.top + Vec{0, 0.4, 0};
    CHECK(lowest_height(create_ode_sphere, c.terrain, start) < -0.5);
    CHECK(lowest_height(create_our_sphere, c.terrain, start) > 0.09);
    CHECK(lowest_height(create_brick, c.terrain, start) > 0.045);
    CHECK(lowest_height(create_egg, c.terrain, start) > 0.045);
    for (const double aside : {1e-9, 0.01, 0.03, -0.05}) {
      CAPTURE(aside);
      CHECK(lowest_height(create_our_sphere, c.terrain, start + Vec{aside, 0, 0.3 * aside}) > 0.09);
    }
  }
}

TEST_CASE("50 bodies on a terrain for 20 s do not fall through") {
  const OdeSession session;
  Random random(61);
  World world;
  set_up(world);
  // The ground is rough, and higher towards the border, so the bodies stay on it.
  const Terrain terrain({25, 25, 6, 6}, [](int i, int j) {
    const double r = std::max(std::abs(i - 12), std::abs(j - 12)) / 12.0;
    return rough(62, 0.15)(i, j) + 2 * r * r * r;
  });
  terrain.create(false, world.space());
  std::vector<dBodyID> bodies;
  std::vector<dGeomID> geoms;
  for (int k = 0; k < 50; ++k) {
    const auto a = dReal(random.uniform(0.05, 0.15));
    const auto b = dReal(random.uniform(0.05, 0.15));
    const auto c = dReal(random.uniform(0.05, 0.15));
    const auto exponent = dReal(k % 3 == 0 ? 2 : random.uniform(1.5, 8));
    geoms.push_back(snCreateSuperellipsoid(world.space(), a, b, c, exponent, exponent));
    bodies.push_back(add(world, geoms.back()));
    dBodySetPosition(bodies.back(), dReal(random.uniform(-2, 2)), dReal(0.5 + 0.04 * k), dReal(random.uniform(-2, 2)));
    dBodySetLinearVel(bodies.back(), dReal(random.uniform(-1, 1)), -1, dReal(random.uniform(-1, 1)));
  }
  for (int step = 0; step < 4000; ++step) {
    world.quick_step(0.005);
    if (step % 40 > 0) continue;
    for (const dBodyID body : bodies) {
      const Vec p = to_vec(dBodyGetPosition(body));
      REQUIRE(std::max(std::abs(p[0]), std::abs(p[2])) < 3);
      REQUIRE(p[1] > terrain.surface(p[0], p[2]));
    }
  }
  // At rest they are on the ground and not in it.
  for (const dGeomID geom : geoms) {
    for (const dContactGeom& contact : collide(geom, dSpaceGetGeom(world.space(), 0), 20)) CHECK(contact.depth < 0.01);
  }
}

TEST_CASE("an infinite heightfield carries a body that rolls far") {
  const OdeSession session;
  World world;
  set_up(world);
  const Terrain terrain({9, 9, 4, 4, true}, rough(63, 0.1));
  terrain.create(false, world.space());
  std::vector<dBodyID> bodies;
  for (int k = 0; k < 5; ++k) {
    bodies.push_back(add(world, k % 2 == 0 ? create_our_sphere(world.space()) : create_egg(world.space())));
    dBodySetPosition(bodies.back(), dReal(3 * k), dReal(0.5), 0);
    dBodySetLinearVel(bodies.back(), dReal(20 - 10 * k), 0, dReal(15));
  }
  for (int step = 0; step < 2000; ++step) {
    world.quick_step(0.005);
    for (const dBodyID body : bodies) {
      const Vec p = to_vec(dBodyGetPosition(body));
      REQUIRE(p[1] > terrain.surface(p[0], p[2]));
    }
  }
  CHECK(norm(to_vec(dBodyGetPosition(bodies[0]))) > 20);
}
