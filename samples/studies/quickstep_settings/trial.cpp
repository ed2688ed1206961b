#include "trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace quickstep_settings {
namespace {

constexpr int kContactsPerPair = 5;

void apply(const Settings& s, Scene& scene) {
  const dWorldID world = scene.world().id();
  dWorldSetQuickStepNumIterations(world, s.iterations);
  dWorldSetERP(world, dReal(s.erp));
  if (s.softness > 0) dWorldSetCFM(world, dReal(s.softness * s.step / scene.mass()));
  dWorldSetContactSurfaceLayer(world, dReal(s.surface_layer * scene.size()));
  if (s.correcting_velocity > 0) dWorldSetContactMaxCorrectingVel(world, dReal(s.correcting_velocity));
  for (const dBodyID body : scene.bodies()) {  // the world's values apply to bodies created later
    dBodySetAngularDamping(body, dReal(s.angular_damping));
    dBodySetAngularDampingThreshold(body, 0);
    dBodySetAutoDisableFlag(body, s.auto_disable ? 1 : 0);
    dBodySetAutoDisableAverageSamplesCount(body, static_cast<unsigned>(s.average_samples));
    dBodySetAutoDisableLinearThreshold(body, dReal(s.linear_threshold));
    dBodySetAutoDisableAngularThreshold(body, dReal(s.angular_threshold));
  }
}

/// Adds the contacts of a pair. Returns the depth of the deepest, m.
double add_contacts(common::OdeWorld& world, dGeomID o1, dGeomID o2) {
  std::array<dContact, kContactsPerPair> found;
  const int count = dCollide(o1, o2, kContactsPerPair, &found[0].geom, sizeof(dContact));
  double deepest = 0;
  for (int i = 0; i < count; ++i) {
    dContact& contact = found[static_cast<std::size_t>(i)];
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = dReal(0.5);
    deepest = std::max(deepest, double{contact.geom.depth});
    world.join(contact);
  }
  return deepest;
}

double mean_square_speed(const Scene& scene) {
  double sum = 0;
  double total = 0;
  for (const dBodyID body : scene.bodies()) {
    dMass mass;
    dBodyGetMass(body, &mass);
    const dReal* const v = dBodyGetLinearVel(body);
    sum += mass.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    total += mass.mass;
  }
  return sum / total;
}

bool all_asleep(const Scene& scene) {
  return std::none_of(scene.bodies().begin(), scene.bodies().end(), [](dBodyID body) { return dBodyIsEnabled(body) != 0; });
}

}  // namespace

Outcome run(Scene& scene, const Settings& settings, double time) {
  apply(settings, scene);
  std::vector<double> start;
  for (const dBodyID body : scene.bodies()) start.push_back(dBodyGetPosition(body)[2]);
  Outcome outcome{0, 0, -1, 0};
  double squares = 0;
  int watched = 0;
  const int steps = static_cast<int>(std::lround(time / settings.step));
  for (int step = 1; step <= steps; ++step) {
    double deepest = 0;  // m
    scene.world().collide([&](dGeomID o1, dGeomID o2) { deepest = std::max(deepest, add_contacts(scene.world(), o1, o2)); });
    scene.world().step(settings.step);
    for (std::size_t i = 0; i < start.size(); ++i) {
      outcome.rise = std::max(outcome.rise, (dBodyGetPosition(scene.bodies()[i])[2] - start[i]) / scene.size());
    }
    if (all_asleep(scene)) {
      if (outcome.asleep < 0) outcome.asleep = step * settings.step;
    } else {
      outcome.asleep = -1;
    }
    if (2 * step <= steps) continue;
    ++watched;
    squares += mean_square_speed(scene);
    outcome.overlap = std::max(outcome.overlap, deepest / scene.size());
  }
  if (watched > 0) outcome.speed = std::sqrt(squares / watched);
  return outcome;
}

}  // namespace quickstep_settings
