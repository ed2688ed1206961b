// Bodies of several geoms: a dumbbell and a molar fall on a plane. Prints their mass, inertia, rest pose and energy.
#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include "compound.hpp"

namespace {

constexpr double kGravity = 9.81;  // m/s^2
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
  bool has_touched;
};

void collide(void* data, dGeomID g1, dGeomID g2) {
  Scene& scene = *static_cast<Scene*>(data);
  dContact contact[kMaxContacts] = {};
  const int count = dCollide(g1, g2, kMaxContacts, &contact[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    // Contacts have friction and a small rolling resistance, because round bodies would roll for a long time.
    contact[i].surface.mode = dContactApprox1 | dContactRolling;
    contact[i].surface.mu = 0.5;
    contact[i].surface.rho = 5e-4;
    contact[i].surface.rhoN = 5e-4;
    dJointAttach(dJointCreateContact(scene.world, scene.contacts, &contact[i]), dGeomGetBody(g1), dGeomGetBody(g2));
    scene.has_touched = true;
  }
}

double energy(dBodyID body, double gravity) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const dReal* v = dBodyGetLinearVel(body);
  const dReal* w = dBodyGetAngularVel(body);
  dVector3 turn, momentum;  // in the body's frame
  dBodyVectorFromWorld(body, w[0], w[1], w[2], turn);
  dMultiply0_331(momentum, mass.I, turn);
  return mass.mass * (0.5 * dCalcVectorDot3(v, v) + gravity * dBodyGetPosition(body)[2]) + 0.5 * dCalcVectorDot3(turn, momentum);
}

bool is_slow(dBodyID body) {
  return std::max(dCalcVectorLength3(dBodyGetLinearVel(body)), dCalcVectorLength3(dBodyGetAngularVel(body))) < kSlow;
}

/// How a body falls on a plane until it rests.
struct Drop {
  double first_energy;  ///< J, kinetic and potential (0 at the plane), at the start
  double flight_error;  ///< J; largest deviation from the integrator's exact energy before the first contact
  double largest_gain;  ///< J; largest rise of the energy above its earlier minimum
  double last_energy;   ///< J
  double rest_time;     ///< s; when it came to rest; negative if it did not
};

/// Steps the world until `body` rests. Gravity must point down the z-axis.
Drop drop(dWorldID world, dSpaceID space, dBodyID body) {
  dVector3 g;
  dWorldGetGravity(world, g);
  const double gravity = -g[2];
  dMass mass;
  dBodyGetMass(body, &mass);
  Scene scene = {world, dJointGroupCreate(0), false};

  Drop result{};
  result.first_energy = energy(body, gravity);
  result.rest_time = -1;
  double least = result.first_energy, quiet = 0;
  const int steps = static_cast<int>(kLongest / kStep);
  for (int i = 1; i <= steps && result.rest_time < 0; ++i) {
    dSpaceCollide(space, &scene, collide);
    dWorldStep(world, kStep);
    dJointGroupEmpty(scene.contacts);

    const double now = energy(body, gravity);
    if (!scene.has_touched) {
      // The semi-implicit Euler method loses m g^2 h^2/2 in each step of a free fall.
      const double expected = result.first_energy - 0.5 * i * mass.mass * std::pow(gravity * kStep, 2);
      result.flight_error = std::max(result.flight_error, std::abs(now - expected));
    }
    result.largest_gain = std::max(result.largest_gain, now - least);
    least = std::min(least, now);
    quiet = is_slow(body) ? quiet + kStep : 0;
    if (quiet >= kQuietTime) result.rest_time = i * kStep - kQuietTime;
  }
  result.last_energy = energy(body, gravity);
  dJointGroupDestroy(scene.contacts);
  return result;
}

/// Drops a body of `parts` and prints the result. Returns whether it is as expected.
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

  const Drop fall = drop(world, space, body);
  const dReal* p = dBodyGetPosition(body);
  const dReal* R = dBodyGetRotation(body);
  const double potential = mass.mass * kGravity * p[2];
  std::printf("  at rest  after %.2f s: centre of mass %.6f m above the plane, its z-axis %.2f degrees from upright\n",
              fall.rest_time, p[2], std::acos(R[10]) * 180 / kPi);
  std::printf(
      "  energy   %.6f J at the start, in flight right to %.0e J; never rose by more than %.1e J;\n"
      "           %.6f J at rest, of which %.6f J potential\n",
      fall.first_energy, fall.flight_error, fall.largest_gain, fall.last_energy, potential);
  const bool parts_touch = std::abs(gap) < 1e-9;
  const bool energy_is_right = fall.flight_error < 1e-9 * fall.first_energy && fall.largest_gain < 0.01 * fall.first_energy &&
                               std::abs(fall.last_energy - potential) < 1e-5 * fall.first_energy;
  dBodyDestroy(body);
  for (const Part& part : parts) dGeomDestroy(part.geom);
  return parts_touch && energy_is_right && fall.rest_time > 0;
}

int run() {
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, -kGravity);
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  dCreatePlane(space, 0, 0, 1, 0);
  const bool dumbbell_is_well = show("dumbbell", world, space, make_dumbbell(space));
  const bool molar_is_well = show("molar", world, space, make_molar(space));
  const bool is_well = dumbbell_is_well && molar_is_well;
  std::puts(is_well ? "both came to rest; parts and energies are right" : "something is wrong: see above");
  dSpaceDestroy(space);
  dWorldDestroy(world);
  return is_well ? 0 : 1;
}

}  // namespace

int main(int argc, char** /*argv*/) {
  if (argc > 1) {
    std::puts("usage: compound\nDrops a dumbbell and a molar of several geoms on a plane, and prints mass, rest and energy.");
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
