#include "drop.hpp"

#include <algorithm>
#include <cmath>

namespace {

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

}  // namespace

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
