// Bodies of several geoms: a dumbbell and a molar fall on a plane. Prints their mass, inertia and rest pose.
#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "compound.hpp"

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Two discs with round edges at the ends of a bar along z.
std::vector<Part> make_dumbbell(dSpaceID space) {
  constexpr double kSteel = 7850;
  constexpr double kBar = 0.08, kDisc = 0.03;  // half-lengths, m
  const dGeomID bar = snCreateSuperellipsoid(space, 0.014, 0.014, kBar, 2, 8);
  const dGeomID disc = snCreateSuperellipsoid(space, 0.06, 0.06, kDisc, 2, 6);
  const dGeomID other = snCreateSuperellipsoid(space, 0.06, 0.06, kDisc, 2, 6);
  return {make_part(bar, kSteel, 0, 0, 0), make_part(disc, kSteel, 0, 0, kBar + kDisc),
          make_part(other, kSteel, 0, 0, -kBar - kDisc)};
}

/// A crown on two roots that taper downwards and spread a little; ten times life size.
std::vector<Part> make_molar(dSpaceID space) {
  constexpr double kEnamel = 2900, kDentine = 2100;
  constexpr double kCrown = 0.035, kRoot = 0.06, kSpread = 0.12;  // half-heights, m; rad
  const dGeomID crown = snCreateSuperovoid(space, 0.055, 0.05, kCrown, 3.5, 4, 0.15, 0.15);
  std::vector<Part> parts = {make_part(crown, kEnamel, 0, 0, 0)};
  for (const double side : {1.0, -1.0}) {
    const dGeomID root = snCreateSuperovoid(space, 0.02, 0.016, kRoot, 2, 3, 0.5, 0.5);
    // Raise the root until it touches the crown. snGeomProximity measures the gap between the two.
    double z = -kCrown - 1.05 * kRoot;
    Part part = make_part(root, kDentine, 0, side * 0.028, z, side * kSpread);
    dGeomSetRotation(root, part.rotation);
    for (int i = 0; i < 50; ++i) {
      dGeomSetPosition(root, part.position[0], part.position[1], part.position[2]);
      snProximity proximity;
      snGeomProximity(root, crown, &proximity);
      part.position[2] += proximity.gap / std::abs(proximity.normal[2]);
      if (std::abs(proximity.gap) < 1e-14) break;
    }
    parts.push_back(part);
  }
  return parts;
}

constexpr double kStep = 0.0005;    // s
constexpr double kLongest = 20;     // s
constexpr double kSlow = 1e-3;      // m/s and rad/s
constexpr double kQuietTime = 0.5;  // s; must be slow for this long
constexpr int kMaxContacts = 16;

struct Scene {
  dWorldID world;
  dJointGroupID contacts;
};

void collide(void* data, dGeomID g1, dGeomID g2) {
  const Scene& scene = *static_cast<Scene*>(data);
  dContact contact[kMaxContacts] = {};
  const int count = dCollide(g1, g2, kMaxContacts, &contact[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    // Contacts have friction and a small rolling resistance, because round bodies would roll for a long time.
    contact[i].surface.mode = dContactApprox1 | dContactRolling;
    contact[i].surface.mu = 0.5;
    contact[i].surface.rho = 5e-4;
    contact[i].surface.rhoN = 5e-4;
    dJointAttach(dJointCreateContact(scene.world, scene.contacts, &contact[i]), dGeomGetBody(g1), dGeomGetBody(g2));
  }
}

bool is_slow(dBodyID body) {
  return std::max(dCalcVectorLength3(dBodyGetLinearVel(body)), dCalcVectorLength3(dBodyGetAngularVel(body))) < kSlow;
}

/// Steps the world until `body` rests. Returns when it came to rest, s; negative if it did not.
double drop(dWorldID world, dSpaceID space, dBodyID body) {
  Scene scene = {world, dJointGroupCreate(0)};
  double time = 0, quiet = 0;
  while (time < kLongest && quiet < kQuietTime) {
    dSpaceCollide(space, &scene, collide);
    dWorldStep(world, kStep);
    dJointGroupEmpty(scene.contacts);
    time += kStep;
    quiet = is_slow(body) ? quiet + kStep : 0;
  }
  dJointGroupDestroy(scene.contacts);
  return quiet < kQuietTime ? -1 : time - kQuietTime;
}

/// Drops a body of `parts` and prints the result. Returns whether the parts touch and the body comes to rest.
bool show(const char* name, dWorldID world, dSpaceID space, const std::vector<Part>& parts) {
  dMass mass;
  const dBodyID body = assemble(world, parts, mass);
  dBodySetPosition(body, 0, 0, 0.4);
  const double gap = least_gap(parts);
  dMatrix3 tilt;
  dRFromAxisAndAngle(tilt, 1, 0.3, 0, 0.35 * kPi);
  dBodySetRotation(body, tilt);
  std::printf("%s of %zu parts, %.1e m between them\n", name, parts.size(), gap);
  std::printf("  mass     %.6f kg, principal and mixed moments of inertia (1e-3 kg m^2)\n", mass.mass);
  std::printf("           xx %.6f  yy %.6f  zz %.6f  xy %.6f  xz %.6f  yz %.6f\n", 1e3 * mass.I[0], 1e3 * mass.I[5],
              1e3 * mass.I[10], 1e3 * mass.I[1], 1e3 * mass.I[2], 1e3 * mass.I[6]);
  const double rest = drop(world, space, body);
  std::printf("  at rest  after %.2f s: centre of mass %.6f m above the plane, its z-axis %.2f degrees from upright\n", rest,
              dBodyGetPosition(body)[2], std::acos(dBodyGetRotation(body)[10]) * 180 / kPi);
  dBodyDestroy(body);
  for (const Part& part : parts) dGeomDestroy(part.geom);
  return std::abs(gap) < 1e-9 && rest > 0;
}

int run() {
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, -9.81);
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  dCreatePlane(space, 0, 0, 1, 0);
  const bool dumbbell_is_well = show("dumbbell", world, space, make_dumbbell(space));
  const bool molar_is_well = show("molar", world, space, make_molar(space));
  const bool is_well = dumbbell_is_well && molar_is_well;
  std::puts(is_well ? "both came to rest, and their parts touch" : "something is wrong: see above");
  dSpaceDestroy(space);
  dWorldDestroy(world);
  return is_well ? 0 : 1;
}

}  // namespace

int main(int argc, char** /*argv*/) {
  if (argc > 1) {
    std::puts("usage: compound\nDrops a dumbbell and a molar of several geoms on a plane, and prints mass and rest.");
    return 2;
  }
  dInitODE2(0);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  int status = 1;
  try {
    status = run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compound: %s\n", error.what());
  }
  snClose();
  dCloseODE();
  return status;
}
