// Tests of snCreateSuperovoid: tapered bodies through the C interface.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

struct Parameters {
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0, taper_x = 0, taper_y = 0;
  explicit Parameters(dGeomID geom) {
    REQUIRE(snGeomSuperovoidGetParams(geom, &a, &b, &c, &delta, &epsilon, &taper_x, &taper_y) == 1);
  }
  bool operator==(const Parameters&) const = default;
};

}  // namespace

TEST_CASE("superovoid: parameters are kept, changed and refused") {
  OdeSession session;
  const Geom egg(snCreateSuperovoid(nullptr, 3, 2, 1, 2.5, 4, 0.5, 0.5));
  REQUIRE(egg != nullptr);
  const Parameters first(egg);
  CHECK(first.c == 1);
  CHECK(first.epsilon == 4);
  CHECK(first.taper_y == dReal(0.5));
  dReal box[6];
  dGeomGetAABB(egg, box);
  CHECK(box[5] == relative(1));

  CHECK(snGeomSuperovoidSetParams(egg, 1, 1, 2, 2, 2, dReal(-0.25), dReal(0.25)) == 1);
  dGeomGetAABB(egg, box);
  CHECK(box[5] == relative(2));
  const Parameters second(egg);
  CHECK(refused(snGeomSuperovoidSetParams(egg, 1, 1, 2, 2, 2, dReal(0.75), 0),
                "snGeomSuperovoidSetParams: taper_x = 0.75 is outside [-0.70710678118"));
  CHECK(Parameters(egg) == second);
  CHECK(refused(snGeomSuperovoidGetParams(egg, box, box, box, box, box, box, nullptr), "taper_y = NULL"));

  CHECK(refused(snCreateSuperovoid(nullptr, 1, 1, 1, 2, 3, dReal(0.25), dReal(0.5)),
                "snCreateSuperovoid: taper_x = 0.25 and taper_y = 0.5 differ, but with epsilon = 3"));
  CHECK(refused(snCreateSuperovoid(nullptr, 1, -1, 1, 2, 3, 0, 0), "half-axis b = -1 m"));
}

TEST_CASE("superovoid: the functions of one kind of body refuse other kinds") {
  OdeSession session;
  const Geom egg(snCreateSuperovoid(nullptr, 3, 2, 1, 2, 2, 0, 0));
  const Geom ellipsoid(snCreateEllipsoid(nullptr, 3, 2, 1));
  CHECK(refused(snGeomSuperovoidSetParams(ellipsoid, 1, 1, 1, 2, 2, 0, 0), "geom is a superellipsoid, but must be a superovoid"));
  CHECK(refused(snGeomSuperellipsoidSetParams(egg, 1, 1, 1, 2, 2),
                "geom is a superovoid, but must be an ellipsoid or a superellipsoid"));
}

TEST_CASE("superovoid: an egg has the right mass and comes to rest on its side") {
  OdeSession session;
  const double a = 0.3, c = 0.4, taper = 0.3, density = 1000;
  World world;
  world.surface.mode = dContactApprox1;
  world.surface.mu = dReal(0.6);
  world.room = 4;
  dWorldSetLinearDamping(world.id(), dReal(0.005));
  dWorldSetAngularDamping(world.id(), dReal(0.005));
  const dGeomID egg = snCreateSuperovoid(world.space(), dReal(a), dReal(a), dReal(c), 2, 2, dReal(taper), dReal(taper));
  world.add_plane();
  dMass mass;
  REQUIRE(snMassSet(&mass, dReal(density), egg) == 1);
  CHECK(mass.mass == relative(density * 4 / 3 * std::numbers::pi * a * a * c * (1 + taper * taper / 5)).epsilon(1e-6));
  const double centroid = c * 2 * taper / 5 / (1 + taper * taper / 5);
  CHECK(mass.c[2] == relative(centroid).epsilon(1e-6));

  // The centre of mass moves to the origin of the body, and the geom by as much below it.
  dMassTranslate(&mass, 0, 0, -mass.c[2]);
  mass.c[0] = mass.c[1] = mass.c[2] = 0;
  const dBodyID body = world.add(egg, mass);
  dGeomSetOffsetPosition(egg, 0, 0, dReal(-centroid));
  dBodySetPosition(body, 0, 0, dReal(0.45));
  turn(body, {1, 0, 0}, 1.2);

  for (int step = 0; step < 6000; ++step) world.exact_step(0.002);
  // At rest the height of the centre of mass over the plane, h(n) + centroid n_z, is minimal. The axis is slightly tilted, with the
  // blunt end down, so that the centre of mass is over the contact point.
  const dReal* R = dBodyGetRotation(body);
  const double axis_up = R[10];
  CHECK(std::abs(axis_up) < 0.5);
  dVector3 down = {0, 0, -1}, lowest;
  REQUIRE(snGeomSupport(egg, down, lowest) == 1);
  const dReal* position = dBodyGetPosition(body);
  CHECK(std::hypot(lowest[0] - position[0], lowest[1] - position[1]) < 2e-3 * a);
  CHECK(norm(to_vec(dBodyGetAngularVel(body))) < 1e-2);
}
