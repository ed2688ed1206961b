#include "world.hpp"

#include <algorithm>
#include <stdexcept>

namespace resting {
namespace {

constexpr double kDensity = 1000;  // kg/m^3
constexpr double kGravity = 9.81;  // m/s^2
constexpr int kMostRoom = 8;       // contacts

}  // namespace

World::World(dSpaceID space, double step, int room, bool looks_ahead)
    : world_(space), step_(step), room_(room), looks_ahead_(looks_ahead) {
  dWorldSetGravity(id(), 0, 0, static_cast<dReal>(-kGravity));
  dWorldSetAutoDisableFlag(id(), 1);
}

dBodyID World::add(double exponent, const std::array<double, 3>& half_axes) {
  const auto a = static_cast<dReal>(half_axes[0]);
  const auto b = static_cast<dReal>(half_axes[1]);
  const auto c = static_cast<dReal>(half_axes[2]);
  dMass mass;
  dGeomID geom = nullptr;
  if (exponent > 0) {
    geom = snCreateSuperellipsoid(space(), a, b, c, static_cast<dReal>(exponent), static_cast<dReal>(exponent));
    if (geom == nullptr || snMassSet(&mass, static_cast<dReal>(kDensity), geom) == 0) throw std::runtime_error(snLastError());
  } else {
    geom = dCreateBox(space(), 2 * a, 2 * b, 2 * c);
    dMassSetBox(&mass, static_cast<dReal>(kDensity), 2 * a, 2 * b, 2 * c);
  }
  return add(geom, mass);
}

dBodyID World::add(dGeomID geom, const dMass& mass) {
  const dBodyID body = world_.add(geom, mass);
  if (looks_ahead_ && dGeomGetClass(geom) == snGeomClass()) snGeomSetLookAhead(geom, static_cast<dReal>(step_));
  return body;
}

void World::step(int number) {
  overlap_ = 0;
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
    overlap_ = std::max(overlap_, double{contact.geom.depth});
    snContactLookAhead(&contact, static_cast<dReal>(step_));
    world_.join(contact);
  }
}

}  // namespace resting
