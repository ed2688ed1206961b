#include "stepper.hpp"

#include <algorithm>
#include <array>

namespace falling_particles {
namespace {

/// The most contacts that a pair may ask for: a face on a face is held by four points and the deepest one.
constexpr int kContactsPerPair = 5;

dSurfaceParameters compile_surface(const Scene& scene) {
  dSurfaceParameters surface{};  // mode 0, mu 0: one constraint row a contact
  if (scene.friction) {
    // Three rows. Approx1 makes mu Coulomb's coefficient; without it ODE takes mu for a force in newtons.
    surface.mode = dContactApprox1;
    surface.mu = scene.friction->coefficient;
  }
  return surface;
}

}  // namespace

Stepper::Stepper(const World& world, const Scene& scene)
    : world_(world), step_(scene.time.step), surface_(compile_surface(scene)), joints_(dJointGroupCreate(0)) {}

Stepper::~Stepper() { dJointGroupDestroy(joints_); }

void Stepper::step() {
  contacts_.clear();
  {
    const Stopwatch::Lap lap(costs_.collision);
    dSpaceCollide(world_.space(), this, &Stepper::near_callback);
  }
  {
    const Stopwatch::Lap lap(costs_.contact_setup);
    dJointGroupEmpty(joints_);
    dContact contact{};
    contact.surface = surface_;
    for (const dContactGeom& geom : contacts_) {
      deepest_contact_ = std::max<double>(deepest_contact_, geom.depth);
      contact.geom = geom;
      dJointID joint = dJointCreateContact(world_.id(), joints_, &contact);
      dJointAttach(joint, dGeomGetBody(geom.g1), dGeomGetBody(geom.g2));
    }
  }
  costs_.contacts += contacts_.size();
  const Stopwatch::Lap lap(costs_.solver);
  dWorldQuickStep(world_.id(), step_);
}

void Stepper::near_callback(void* self, dGeomID g1, dGeomID g2) { static_cast<Stepper*>(self)->collide(g1, g2); }

void Stepper::collide(dGeomID g1, dGeomID g2) {
  std::array<dContactGeom, kContactsPerPair> found;
  ++costs_.pairs_tested;
  int count = 0;
  {
    const Stopwatch::Lap lap(costs_.narrow_phase);
    count = dCollide(g1, g2, kContactsPerPair, found.data(), sizeof(dContactGeom));
  }
  contacts_.insert(contacts_.end(), found.begin(), found.begin() + count);
}

}  // namespace falling_particles
