#include "stepper.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <variant>

namespace falling_particles {
namespace {

bool is_awake(dGeomID geom) {
  const dBodyID body = dGeomGetBody(geom);
  return body != nullptr && dBodyIsEnabled(body) != 0;
}

bool may_sleep(const Scene& scene) {
  return std::ranges::any_of(scene.effects,
                             [](const auto& effect) { return std::holds_alternative<supernormal::effects::AutoDisable>(effect); });
}

}  // namespace

Stepper::Stepper(const World& world, const Scene& scene, int threads)
    : world_(world),
      step_(scene.time.step),
      name_pair_(may_sleep(scene) ? &Stepper::name_pair_of_sleepers : &Stepper::name_pair),
      joints_(world),
      batch_(snBatchCreate(threads)) {
  if (batch_ == nullptr) throw std::runtime_error(snLastError());
  world_.effects().measure();
}

Stepper::~Stepper() { snBatchDestroy(batch_); }

void Stepper::step() {
  contacts_.clear();
  if (PeriodicCell* cell = world_.cell()) cell->place_images();
  {
    const Stopwatch::Lap lap(costs_.collision);
    costs_.broad_phase.start();
    if (snBatchCollide(batch_, world_.space(), kContactsPerPair, this, name_pair_, &Stepper::add_contacts) < 0) {
      throw std::runtime_error(snLastError());
    }
  }
  {
    const Stopwatch::Lap lap(costs_.contact_setup);
    joints_.replace(contacts_);
    world_.effects().apply_forces();
  }
  costs_.contacts += contacts_.size();
  for (const dContactGeom& contact : contacts_) deepest_contact_ = std::max<double>(deepest_contact_, contact.depth);
  const Stopwatch::Lap lap(costs_.solver);
  dWorldQuickStep(world_.id(), step_);
  if (PeriodicCell* cell = world_.cell()) cell->gather();
}

int Stepper::name_pair_of_sleepers(void* self, dGeomID g1, dGeomID g2) {
  return is_awake(g1) || is_awake(g2) ? name_pair(self, g1, g2) : 0;
}

int Stepper::name_pair(void* self, dGeomID /*g1*/, dGeomID /*g2*/) {
  StepCosts& costs = static_cast<Stepper*>(self)->costs_;
  ++costs.pairs_tested;
  costs.broad_phase.lap();  // the last of these ends it
  return 1;
}

void Stepper::add_contacts(void* self, dGeomID /*g1*/, dGeomID /*g2*/, const dContactGeom* contacts, int count) {
  Stepper& stepper = *static_cast<Stepper*>(self);
  const PeriodicCell* cell = stepper.world_.cell();
  for (const dContactGeom& contact : std::span(contacts, static_cast<std::size_t>(count))) {
    if (cell == nullptr || cell->contains(contact.pos)) stepper.contacts_.push_back(contact);
  }
}

}  // namespace falling_particles
