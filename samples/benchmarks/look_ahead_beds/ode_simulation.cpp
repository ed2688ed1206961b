#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "simulation.hpp"

namespace look_ahead_beds {
namespace {

constexpr int kMaxContacts = 8;              // contacts per pair
constexpr double kRowsOfContact = 3;         // normal and two friction rows
constexpr double kCorrectingVelocity = 0.1;  // m/s; as recommended for grains that overlap deeply

class OdeSimulation final : public Simulation {
 public:
  OdeSimulation(const Bed& bed, const Settings& settings, bool looks_ahead) : settings_(settings) {
    const auto step = static_cast<dReal>(settings.step);
    dWorldSetGravity(world_, 0, 0, static_cast<dReal>(-kGravity));
    dWorldSetQuickStepNumIterations(world_, settings.iterations);
    dWorldSetContactMaxCorrectingVel(world_, static_cast<dReal>(kCorrectingVelocity));
    dRandSetSeed(1);
    for (const Grain& grain : bed.grains) {
      const dGeomID geom = create_geom(grains_, bed, grain);
      dMass mass;
      if (snMassSet(&mass, static_cast<dReal>(kDensity), geom) == 0) throw std::runtime_error(snLastError());
      const dBodyID body = dBodyCreate(world_);
      dBodySetMass(body, &mass);
      dGeomSetBody(geom, body);
      const Pose& start = grain.start;
      dBodySetPosition(body, static_cast<dReal>(start.position[0]), static_cast<dReal>(start.position[1]),
                       static_cast<dReal>(start.position[2]));
      dQuaternion quaternion;
      for (std::size_t k = 0; k < 4; ++k) quaternion[k] = static_cast<dReal>(start.quaternion[k]);
      dBodySetQuaternion(body, quaternion);
      if (looks_ahead && snGeomSetLookAhead(geom, step) == 0) throw std::runtime_error(snLastError());
      bodies_.push_back(body);
    }
    for (const auto& w : bed.walls()) {
      dCreatePlane(walls_, static_cast<dReal>(w[0]), static_cast<dReal>(w[1]), static_cast<dReal>(w[2]), static_cast<dReal>(w[3]));
    }
  }

  ~OdeSimulation() override {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(grains_);
    dSpaceDestroy(walls_);
    dWorldDestroy(world_);
  }

  OdeSimulation(const OdeSimulation&) = delete;
  OdeSimulation(OdeSimulation&&) = delete;
  OdeSimulation& operator=(const OdeSimulation&) = delete;
  OdeSimulation& operator=(OdeSimulation&&) = delete;

  void step() override {
    snResetStatistics();
    const double start = processor_time();
    dSpaceCollide(grains_, this, near_callback);
    const auto to_geom = [](dSpaceID space) { return reinterpret_cast<dGeomID>(space); };
    dSpaceCollide2(to_geom(grains_), to_geom(walls_), this, near_callback);
    const double found = processor_time();
    dWorldQuickStep(world_, static_cast<dReal>(settings_.step));
    dJointGroupEmpty(joints_);
    spent().finding += found - start;
    spent().solving += processor_time() - found;
    snStatistics statistics;
    snGetStatistics(&statistics);
    spent().evaluations += static_cast<double>(statistics.evaluations_cold + statistics.evaluations_warm);
  }

  Pose pose(std::size_t grain) const override {
    const dReal* const p = dBodyGetPosition(bodies_[grain]);
    const dReal* const q = dBodyGetQuaternion(bodies_[grain]);
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  }

  double kinetic_energy() const override {
    double energy = 0;
    for (const dBodyID body : bodies_) {
      dMass mass;
      dBodyGetMass(body, &mass);
      energy += 0.5 * double{mass.mass} * std::pow(double{dCalcVectorLength3(dBodyGetLinearVel(body))}, 2);
    }
    return energy;
  }

 private:
  static void near_callback(void* self, dGeomID o1, dGeomID o2) {
    OdeSimulation& world = *static_cast<OdeSimulation*>(self);
    std::array<dContact, kMaxContacts> found;
    const int count = dCollide(o1, o2, kMaxContacts, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = static_cast<dReal>(kFriction);
      snContactLookAhead(&contact, static_cast<dReal>(world.settings_.step));
      dJointAttach(dJointCreateContact(world.world_, world.joints_, &contact), dGeomGetBody(o1), dGeomGetBody(o2));
    }
    world.spent().rows += kRowsOfContact * count * world.settings_.iterations;
  }

  Settings settings_;
  dWorldID world_ = dWorldCreate();
  dSpaceID grains_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  dSpaceID walls_ = dSimpleSpaceCreate(nullptr);
  dJointGroupID joints_ = dJointGroupCreate(0);
  std::vector<dBodyID> bodies_;
};

}  // namespace

std::unique_ptr<Simulation> start_plain(const Bed& bed, const Settings& settings) {
  return std::make_unique<OdeSimulation>(bed, settings, false);
}

std::unique_ptr<Simulation> start_ahead(const Bed& bed, const Settings& settings) {
  return std::make_unique<OdeSimulation>(bed, settings, true);
}

}  // namespace look_ahead_beds
