/* An ODE program in C99 that has only what is installed. */
#include <math.h>
#include <stdio.h>
#include <supernormal/supernormal.h>

static int failures = 0;

static void check(int condition, const char* what) {
  if (condition) return;
  ++failures;
  printf("failed: %s\n", what);
}

int main(void) {
  const dReal tolerance = sizeof(dReal) == sizeof(double) ? (dReal)1e-9 : (dReal)1e-5;
  const dReal depth = (dReal)0.125;
  const dReal pi = (dReal)3.14159265358979323846;
  dSpaceID space;
  dGeomID plane, body;
  dMass mass;
  dContactGeom contact;

  dInitODE2(0);
  if (snInit() != 1) {
    printf("snInit: %s\n", snLastError());
    return 1;
  }
  space = dSimpleSpaceCreate(0);
  plane = dCreatePlane(space, 0, 0, 1, 0);
  body = snCreateEllipsoid(space, 3, 2, 1);
  check(body != 0, "snCreateEllipsoid");
  check(dGeomGetClass(body) == snGeomClass(), "the class of the geom");
  dGeomSetPosition(body, 0, 0, 1 - depth);

  check(snMassSet(&mass, 1, body) == 1, "snMassSet");
  check(fabs(mass.mass - 8 * pi) < tolerance * 8 * pi, "mass of density 1 = volume = 4/3 pi abc");

  check(dCollide(body, plane, 1, &contact, sizeof contact) == 1, "one contact with the plane");
  check(fabs(contact.depth - depth) < tolerance, "its depth");
  check(fabs(contact.normal[2] - 1) < tolerance, "its normal, into the body");

  check(snCreateSuperellipsoid(space, 1, 1, 1, 2, (dReal)0.5) == 0, "an exponent of 0.5 is refused");
  check(snLastError()[0] != '\0', "the refusal has a reason");

  dSpaceDestroy(space);
  snClose();
  dCloseODE();
  if (failures == 0) printf("C99 program by pkg-config: all right\n");
  return failures != 0;
}
