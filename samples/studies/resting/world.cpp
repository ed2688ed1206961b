#include "world.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <stdexcept>

namespace resting {
namespace {

constexpr double kDensity = 1000;  // kg/m^3
constexpr double kGravity = 9.81;  // m/s^2
constexpr int kMostRoom = 8;       // contacts

}  // namespace

World::World(dSpaceID space, double step, int room, bool looks_ahead)
    : space_(space), step_(step), room_(room), looks_ahead_(looks_ahead) {
  dWorldSetGravity(world_, 0, 0, static_cast<dReal>(-kGravity));
  dWorldSetAutoDisableFlag(world_, 1);
}

World::~World() {
  dJointGroupDestroy(joints_);
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
}

dBodyID World::add(double exponent, const std::array<double, 3>& half_axes) {
  const auto a = static_cast<dReal>(half_axes[0]);
  const auto b = static_cast<dReal>(half_axes[1]);
  const auto c = static_cast<dReal>(half_axes[2]);
  dMass mass;
  dGeomID geom = nullptr;
  if (exponent > 0) {
    geom = snCreateSuperellipsoid(space_, a, b, c, static_cast<dReal>(exponent), static_cast<dReal>(exponent));
    if (geom == nullptr || snMassSet(&mass, static_cast<dReal>(kDensity), geom) == 0) throw std::runtime_error(snLastError());
  } else {
    geom = dCreateBox(space_, 2 * a, 2 * b, 2 * c);
    dMassSetBox(&mass, static_cast<dReal>(kDensity), 2 * a, 2 * b, 2 * c);
  }
  return add(geom, mass);
}

dBodyID World::add(dGeomID geom, const dMass& mass) {
  const dBodyID body = dBodyCreate(world_);
  dBodySetMass(body, &mass);
  dGeomSetBody(geom, body);
  if (looks_ahead_ && dGeomGetClass(geom) == snGeomClass()) snGeomSetLookAhead(geom, static_cast<dReal>(step_));
  return body;
}

void World::step(int number) {
  overlap_ = 0;
  dSpaceCollide(space_, this, near_callback);
  dRandSetSeed(static_cast<unsigned long>(number));
  dWorldQuickStep(world_, static_cast<dReal>(step_));
  dJointGroupEmpty(joints_);
}

void World::near_callback(void* self, dGeomID o1, dGeomID o2) {
  World& world = *static_cast<World*>(self);
  std::array<dContact, kMostRoom> found;
  const int count = dCollide(o1, o2, world.room_, &found[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dContact& contact = found[static_cast<std::size_t>(i)];
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = static_cast<dReal>(0.5);
    world.overlap_ = std::max(world.overlap_, double{contact.geom.depth});
    snContactLookAhead(&contact, static_cast<dReal>(world.step_));
    dJointAttach(dJointCreateContact(world.world_, world.joints_, &contact), dGeomGetBody(o1), dGeomGetBody(o2));
  }
}

}  // namespace resting
