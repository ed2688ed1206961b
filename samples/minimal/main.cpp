// Drops a brick with round edges (a superellipsoid with exponents 8) on a plane and prints where it comes to rest.
#include <supernormal/supernormal.h>

#include <cstdio>

namespace {

dWorldID world;
dJointGroupID contacts;

void collide(void* /*data*/, dGeomID g1, dGeomID g2) {
  dContact contact[8] = {};
  const int count = dCollide(g1, g2, 8, &contact[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    contact[i].surface.mode = dContactApprox1;
    contact[i].surface.mu = 0.5;
    dJointAttach(dJointCreateContact(world, contacts, &contact[i]), dGeomGetBody(g1), dGeomGetBody(g2));
  }
}

}  // namespace

int main() {
  dInitODE2(0);
  world = dWorldCreate();
  contacts = dJointGroupCreate(0);
  dWorldSetGravity(world, 0, 0, -9.81);
  dSpaceID space = dHashSpaceCreate(nullptr);
  dCreatePlane(space, 0, 0, 1, 0);

  dGeomID brick = snCreateSuperellipsoid(space, 0.1, 0.07, 0.05, 8, 8);  // half-axes in m, exponents
  dMass mass;
  snMassSet(&mass, 1000, brick);  // kg/m^3
  dBodyID body = dBodyCreate(world);
  dBodySetMass(body, &mass);
  dGeomSetBody(brick, body);
  dBodySetPosition(body, 0, 0, 0.5);

  for (int step = 0; step < 1000; ++step) {
    dSpaceCollide(space, nullptr, collide);
    dWorldQuickStep(world, 0.002);
    dJointGroupEmpty(contacts);
  }
  std::printf("after 2 s the centre of the brick is %.4f m above the plane\n", dBodyGetPosition(body)[2]);

  dSpaceDestroy(space);
  dJointGroupDestroy(contacts);
  dWorldDestroy(world);
  snClose();
  dCloseODE();
}
