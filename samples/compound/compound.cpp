#include "compound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

Part make_part(dGeomID geom, double density, double x, double y, double z, double angle) {
  if (geom == nullptr) throw std::runtime_error(snLastError());
  Part part{geom, density, {x, y, z}, {}};
  dRFromAxisAndAngle(part.rotation, 1, 0, 0, angle);
  return part;
}

dBodyID assemble(dWorldID world, const std::vector<Part>& parts, dMass& mass) {
  dMassSetZero(&mass);
  for (const Part& part : parts) {
    dMass share;
    if (snMassSet(&share, part.density, part.geom) == 0) throw std::runtime_error(snLastError());
    dMassRotate(&share, part.rotation);  // rotates about the part's origin, so it precedes the translation
    dMassTranslate(&share, part.position[0], part.position[1], part.position[2]);
    dMassAdd(&mass, &share);
  }
  // ODE requires the centre of mass at the body's origin. Move the frame there, with all parts.
  const dVector3 centre = {mass.c[0], mass.c[1], mass.c[2]};
  dMassTranslate(&mass, -centre[0], -centre[1], -centre[2]);
  std::fill(mass.c, mass.c + 3, 0.0);  // remove rounding

  const dBodyID body = dBodyCreate(world);
  dBodySetMass(body, &mass);
  for (const Part& part : parts) {
    dGeomSetBody(part.geom, body);  // this resets the offset, so set the offset afterwards
    dGeomSetOffsetPosition(part.geom, part.position[0] - centre[0], part.position[1] - centre[1], part.position[2] - centre[2]);
    dGeomSetOffsetRotation(part.geom, part.rotation);
  }
  return body;
}

double least_gap(const std::vector<Part>& parts) {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& first : parts) {
    for (const Part& second : parts) {
      if (first.geom == second.geom) continue;
      snProximity proximity;
      if (snGeomProximity(first.geom, second.geom, &proximity) == 0) throw std::runtime_error(snLastError());
      least = std::min(least, double{proximity.gap});
    }
  }
  return least;
}
