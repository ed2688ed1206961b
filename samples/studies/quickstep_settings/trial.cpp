#include "trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace quickstep_settings {

namespace {

constexpr double kDensity = 1000;  // kg/m^3
constexpr double kBoxy = 20;       // exponent

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

Scene::Scene(double size) : size_(size), world_(dHashSpaceCreate(nullptr)) {
  const int level = static_cast<int>(std::ceil(std::log2(4 * size)));
  dHashSpaceSetLevels(world_.space(), level - 1, level + 1);
  dWorldSetGravity(world_.id(), 0, 0, dReal(-9.81));
  dCreatePlane(world_.space(), 0, 0, 1, 0);
  dRandSetSeed(1);
}

void Scene::add(double exponent, double density, std::array<double, 3> position, std::array<double, 4> quaternion) {
  const auto [x, y, z] = position;
  const dGeomID geom =
      snCreateSuperellipsoid(world_.space(), dReal(2 * size_), dReal(1.4 * size_), dReal(size_), dReal(exponent), dReal(exponent));
  const dBodyID body = world_.add(geom, density);
  dBodySetPosition(body, dReal(size_ * x), dReal(size_ * y), dReal(size_ * z));
  dQuaternion q = {dReal(quaternion[0]), dReal(quaternion[1]), dReal(quaternion[2]), dReal(quaternion[3])};
  dNormalize4(q);
  dBodySetQuaternion(body, q);
  bodies_.push_back(body);
}

void Scene::add_walls(double half_width) {
  for (const double side : {-1.0, 1.0}) {
    dCreatePlane(world_.space(), dReal(-side), 0, 0, dReal(-half_width * size_));
    dCreatePlane(world_.space(), 0, dReal(-side), 0, dReal(-half_width * size_));
  }
}

double Scene::mass() const {
  dMass mass;
  dBodyGetMass(bodies_.front(), &mass);
  return mass.mass;
}

void fill_brick(Scene& scene) { scene.add(kBoxy, kDensity, {0, 0, 3}, {1, 0.05, 0.02, 0}); }

void fill_stack(Scene& scene) {
  for (int i = 0; i < 10; ++i) {
    const double tilt = i % 2 == 0 ? 0.005 : -0.005;
    scene.add(kBoxy, kDensity, {0, 0, 1.02 + 2.05 * i}, {1, tilt, 0.7 * tilt, 0});
  }
}

void fill_heavy(Scene& scene) {
  for (int i = 0; i < 3; ++i) scene.add(kBoxy, i == 2 ? 20 * kDensity : kDensity, {0, 0, 1.02 + 2.05 * i}, {1, 0.005, -0.003, 0});
}

void fill_pebble(Scene& scene) { scene.add(2, kDensity, {0, 0, 3}, {1, 0.05, 0.02, 0}); }

void fill_sunk(Scene& scene) { scene.add(kBoxy, kDensity, {0, 0, 0.7}); }

void fill_grains(Scene& scene) {
  scene.add_walls(8);
  std::mt19937_64 engine(3);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11U) * 0x1p-52 - 1; };  // in [-1, 1)
  for (int i = 0; i < 40; ++i) {
    const double exponent = std::array<double, 4>{2, 2, 3, kBoxy}[static_cast<std::size_t>(i % 4)];
    const std::array<double, 4> orientation = {uniform(), uniform(), uniform(), uniform()};
    const int layer = i / 9;
    const int row = i / 3 % 3 - 1;
    scene.add(exponent, kDensity, {5.0 * (i % 3 - 1), 5.0 * row, 3 + 5.0 * layer}, orientation);
  }
}

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
