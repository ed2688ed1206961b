#include "stepper.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <variant>

namespace falling_particles {
namespace {

/// The most contacts that a pair may ask for: a face on a face is held by four points and the deepest one.
constexpr int kContactsPerPair = 5;

/// The contacts of a pair follow one another.
bool is_same_pair(const dContactGeom& a, const dContactGeom& b) { return a.g1 == b.g1 && a.g2 == b.g2; }

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
      joints_(dJointGroupCreate(0)),
      batch_(snBatchCreate(threads)) {
  if (batch_ == nullptr) throw std::runtime_error(snLastError());
  world_.effects().measure();
}

Stepper::~Stepper() {
  snBatchDestroy(batch_);
  dJointGroupDestroy(joints_);
}

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
    dJointGroupEmpty(joints_);
    for (std::size_t first = 0, end = 0; first < contacts_.size(); first = end) {
      while (end < contacts_.size() && is_same_pair(contacts_[first], contacts_[end])) ++end;
      attach(std::span(contacts_).subspan(first, end - first));
    }
    world_.effects().apply_forces();
  }
  costs_.contacts += contacts_.size();
  const Stopwatch::Lap lap(costs_.solver);
  dWorldQuickStep(world_.id(), step_);
  if (PeriodicCell* cell = world_.cell()) cell->gather();
}

void Stepper::attach(std::span<const dContactGeom> pair) {
  std::array<dContact, kContactsPerPair> contacts;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    contacts[i].geom = pair[i];
    deepest_contact_ = std::max<double>(deepest_contact_, pair[i].depth);
  }
  const int count =
      world_.effects().set_up_contacts(std::span(contacts).first(pair.size()), material_of(pair[0].g1), material_of(pair[0].g2));
  for (int i = 0; i < count; ++i) {
    const dContact& contact = contacts[static_cast<std::size_t>(i)];
    const dJointID joint = dJointCreateContact(world_.id(), joints_, &contact);
    dJointAttach(joint, dGeomGetBody(contact.geom.g1), dGeomGetBody(contact.geom.g2));
  }
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
