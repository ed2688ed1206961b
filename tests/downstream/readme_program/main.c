/* The README's first program, with a main function that drops twenty of its pebbles and waits until all sleep. */
#include <stdio.h>

#include "program.h"

int main(void) {
  enum { kPebbles = 20 };
  const double step = 0.002, longest = 10; /* s */
  dSpaceID space;
  dBodyID pebbles[kPebbles];
  double time;
  int i, awake = kPebbles;

  start();
  dRandSetSeed(1);
  space = dHashSpaceCreate(0);
  dCreatePlane(space, 0, 0, 1, 0);
  for (i = 0; i < kPebbles; ++i) {
    pebbles[i] = dGeomGetBody(drop(space));
    dBodySetPosition(pebbles[i], (dReal)0.01 * (i % 3), (dReal)0.008 * (i % 5), (dReal)0.05 * (i + 1));
    /* Each pebble turns in another way. */
    dBodySetAngularVel(pebbles[i], i % 7, -i % 4, i % 3);
  }
  for (time = 0; time < longest && awake > 0; time += step) {
    dSpaceCollide(space, 0, collide);
    dWorldQuickStep(world, (dReal)step);
    dJointGroupEmpty(contacts);
    for (i = 0, awake = 0; i < kPebbles; ++i) awake += dBodyIsEnabled(pebbles[i]);
  }
  printf("%d of %d pebbles are awake after %.2f s\n", awake, (int)kPebbles, time);
  dSpaceDestroy(space);
  dWorldDestroy(world);
  snClose();
  dCloseODE();
  return awake != 0;
}
