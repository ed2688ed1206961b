#include "world.hpp"

#include <array>

namespace resting {
namespace {

constexpr double kGravity = 9.81;  // m/s^2
constexpr int kMostRoom = 8;       // contacts

}  // namespace

World::World(dSpaceID space, double step, int room, bool looks_ahead)
    : world_(space), step_(step), room_(room), looks_ahead_(looks_ahead) {
  dWorldSetGravity(id(), 0, 0, static_cast<dReal>(-kGravity));
  dWorldSetAutoDisableFlag(id(), 1);
}

dBodyID World::add(dGeomID geom, const dMass& mass) {
  const dBodyID body = world_.add(geom, mass);
  if (looks_ahead_ && dGeomGetClass(geom) == snGeomClass()) snGeomSetLookAhead(geom, static_cast<dReal>(step_));
  return body;
}

void World::step(int number) {
  world_.collide([this](dGeomID o1, dGeomID o2) { add_contacts(o1, o2); });
  dRandSetSeed(static_cast<unsigned long>(number));
  world_.step(step_);
}

void World::add_contacts(dGeomID o1, dGeomID o2) {
  std::array<dContact, kMostRoom> found;
  const int count = dCollide(o1, o2, room_, &found[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dContact& contact = found[static_cast<std::size_t>(i)];
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = static_cast<dReal>(0.5);
    snContactLookAhead(&contact, static_cast<dReal>(step_));
    world_.join(contact);
  }
}

}  // namespace resting
