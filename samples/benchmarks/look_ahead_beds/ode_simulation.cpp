#include <array>
#include <stdexcept>
#include <vector>

#include "bed.hpp"
#include "common/ode_world.hpp"

namespace look_ahead_beds {
namespace {

constexpr int kMaxContacts = 8;              // contacts per pair
constexpr double kCorrectingVelocity = 0.1;  // m/s; as recommended for grains that overlap deeply

class OdeSimulation final : public Simulation {
 public:
  OdeSimulation(const Bed& bed, const Settings& settings, bool looks_ahead) : settings_(settings) {
    const auto step = static_cast<dReal>(settings.step);
    dWorldSetGravity(world_.id(), 0, 0, static_cast<dReal>(-kGravity));
    dWorldSetQuickStepNumIterations(world_.id(), settings.iterations);
    dWorldSetContactMaxCorrectingVel(world_.id(), static_cast<dReal>(kCorrectingVelocity));
    dRandSetSeed(1);
    for (const Grain& grain : bed.grains) {
      const dGeomID geom = create_geom(world_.space(), bed, grain);
      const dBodyID body = world_.add(geom, kDensity);
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

  ~OdeSimulation() override { dSpaceDestroy(walls_); }

  void step() override {
    const auto near = [this](dGeomID o1, dGeomID o2) { add_contacts(o1, o2); };
    world_.collide(near);
    world_.collide_with(walls_, near);
    world_.step(settings_.step);
  }

  Pose pose(std::size_t grain) const override {
    const dReal* const p = dBodyGetPosition(bodies_[grain]);
    const dReal* const q = dBodyGetQuaternion(bodies_[grain]);
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  }

 private:
  void add_contacts(dGeomID o1, dGeomID o2) {
    std::array<dContact, kMaxContacts> found;
    const int count = dCollide(o1, o2, kMaxContacts, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = static_cast<dReal>(kFriction);
      snContactLookAhead(&contact, static_cast<dReal>(settings_.step));
      world_.join(contact);
    }
  }

  Settings settings_;
  common::OdeWorld world_{dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)};
  dSpaceID walls_ = dSimpleSpaceCreate(nullptr);
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
