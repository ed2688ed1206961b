// Drops a brick with round edges (a superellipsoid with exponents 8) and twenty pebbles on a plane. Prints where the brick comes to
// rest and when all bodies sleep.
#include <supernormal/supernormal.h>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

constexpr dReal kStep = 0.002;  // s

dWorldID world;
dJointGroupID contacts;

void collide(void* /*data*/, dGeomID g1, dGeomID g2) {
  dContact contact[8] = {};
  const int count = dCollide(g1, g2, 8, &contact[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    contact[i].surface.mode = dContactApprox1;
    contact[i].surface.mu = 0.5;
    snContactLookAhead(&contact[i], kStep);
    dJointAttach(dJointCreateContact(world, contacts, &contact[i]), dGeomGetBody(g1), dGeomGetBody(g2));
  }
}

dBodyID drop(dGeomID geom, dReal x, dReal y, dReal z) {
  dMass mass;
  snMassSet(&mass, 2650, geom);  // kg/m^3
  dBodyID body = dBodyCreate(world);
  dBodySetMass(body, &mass);
  dGeomSetBody(geom, body);
  dBodySetPosition(body, x, y, z);
  return body;
}

}  // namespace

int main(int argc, char** /*argv*/) {
  if (argc > 1) {
    std::puts("usage: minimal\nDrops a brick and twenty pebbles on a plane, and prints where they rest.");
    return 2;
  }
  constexpr int kPebbles = 20;
  constexpr int kMostSteps = 5000;  // 10 s

  dInitODE2(0);
  world = dWorldCreate();
  contacts = dJointGroupCreate(0);
  dWorldSetGravity(world, 0, 0, -9.81);
  dWorldSetAutoDisableFlag(world, 1);
  dWorldSetAutoDisableAverageSamplesCount(world, 10);
  dWorldSetAutoDisableAngularThreshold(world, 0.01 / 0.008);  // rad/s: ODE's 0.01 m/s over the smallest half-axis
  // A pebble touches the plane at one point, which does not resist rolling: without these two lines it would roll for ever. The
  // physical model is RollingResistance of <supernormal/effects.hpp>. It is for C++ programs; the C interface has none.
  dWorldSetAngularDamping(world, 0.01);
  dWorldSetAngularDampingThreshold(world, 0);
  // Contacts before overlap prevent tunnelling through the plane, also at longer steps.
  snSetDefaultLookAhead(kStep);
  dSpaceID space = dHashSpaceCreate(nullptr);
  dCreatePlane(space, 0, 0, 1, 0);

  // The arguments are half-axes in m and exponents.
  dBodyID brick = drop(snCreateSuperellipsoid(space, 0.1, 0.07, 0.05, 8, 8), 0, 0, 0.5);
  std::vector<dBodyID> bodies{brick};
  for (int i = 0; i < kPebbles; ++i) {
    dGeomID pebble = snCreateSuperellipsoid(space, 0.02, 0.015, 0.008, 2.3, 2.0);
    bodies.push_back(drop(pebble, 0.3 + 0.01 * (i % 3), 0.008 * (i % 5), 0.05 * (i + 1)));
    dBodySetAngularVel(bodies.back(), i % 7, -(i % 4), i % 3);
  }

  const auto is_awake = [](dBodyID body) { return dBodyIsEnabled(body) != 0; };
  int step = 0;
  for (; step < kMostSteps && std::any_of(bodies.begin(), bodies.end(), is_awake); ++step) {
    dSpaceCollide(space, nullptr, collide);
    dWorldQuickStep(world, kStep);
    dJointGroupEmpty(contacts);
  }
  const auto awake = std::count_if(bodies.begin(), bodies.end(), is_awake);
  std::printf("the centre of the brick is %.4f m above the plane\n", dBodyGetPosition(brick)[2]);
  std::printf("%d of %d bodies are awake after %.1f s\n", int(awake), int(bodies.size()), step * kStep);

  dSpaceDestroy(space);
  dJointGroupDestroy(contacts);
  dWorldDestroy(world);
  snClose();
  dCloseODE();
}
