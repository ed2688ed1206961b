#include "supernormal/effects.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "effects/body_forces.hpp"
#include "effects/laws.hpp"
#include "effects/pair_material.hpp"
#include "effects/speculative_contacts.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::effects {
namespace {

using Clock = std::chrono::steady_clock;

/// Sets the world's parameter for an effect that ODE itself applies.
void write_to(dWorldID world, const Effect& effect, double step) {
  if (const auto* gravity = std::get_if<Gravity>(&effect)) {
    const Vector3& g = gravity->acceleration;
    dWorldSetGravity(world, ode::to_real(g.x()), ode::to_real(g.y()), ode::to_real(g.z()));
  } else if (const auto* damping = std::get_if<Damping>(&effect)) {
    // In every step ODE multiplies a velocity above the threshold by 1 - scale.
    dWorldSetLinearDampingThreshold(world, 0);
    dWorldSetAngularDampingThreshold(world, 0);
    dWorldSetLinearDamping(world, ode::to_real(-std::expm1(-damping->linear * step)));
    dWorldSetAngularDamping(world, ode::to_real(-std::expm1(-damping->angular * step)));
  } else if (const auto* sleep = std::get_if<AutoDisable>(&effect)) {
    dWorldSetAutoDisableFlag(world, 1);
    dWorldSetAutoDisableLinearThreshold(world, ode::to_real(sleep->linear));
    dWorldSetAutoDisableAngularThreshold(world, ode::to_real(sleep->angular));
    dWorldSetAutoDisableTime(world, ode::to_real(sleep->time));
    dWorldSetAutoDisableSteps(world, sleep->samples);
    dWorldSetAutoDisableAverageSamplesCount(world, static_cast<unsigned>(sleep->samples));
  } else if (const auto* correcting = std::get_if<MaxCorrectingVelocity>(&effect)) {
    dWorldSetContactMaxCorrectingVel(world, ode::to_real(correcting->velocity));
  } else if (const auto* layer = std::get_if<SurfaceLayer>(&effect)) {
    dWorldSetContactSurfaceLayer(world, ode::to_real(layer->depth));
  }
}

std::vector<Effect> validated(const std::vector<Effect>& list, Solver solver) {
  require_valid(list);
  for (const Effect& effect : list) {
    const bool is_of_step = std::holds_alternative<Compliance>(effect) || std::holds_alternative<Hertz>(effect) ||
                            std::holds_alternative<Adhesion>(effect) || std::holds_alternative<SpeculativeContacts>(effect);
    if (solver != Solver::Stepper || !is_of_step) continue;
    const char* const name = descriptions()[effect.index()].name;
    throw BadEffect(
        name, "",
        std::string(name) + (std::holds_alternative<SpeculativeContacts>(effect)
                                 ? " is listed for a stepper, whose bodies look ahead by themselves; allowed: no such effect"
                                 : " is listed for a stepper, in whose sub-steps it does not act; allowed: quickstep"));
  }
  return list;
}

/// Calls `act` with each of our geoms on a body, and its shape.
template <typename Act>
void for_ours(dBodyID body, const Act& act) {
  for (dGeomID geom = dBodyGetFirstGeom(body); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
    if (ode::Body* const ours = ode::find_body(geom)) act(geom, *ours);
  }
}

/// Makes all our geoms on a body look ahead by `time` (s). `impacts`: what lets its impacts happen, or null.
void look_ahead(dBodyID body, double time, const std::shared_ptr<const void>& impacts) {
  bool has_ours = false;
  for_ours(body, [&](dGeomID geom, ode::Body& ours) {
    const auto other = ours.impacts();
    // Each would let the impacts happen that it knows, and multiply the energy of the body.
    if (impacts && other && other != impacts) {
      throw std::invalid_argument(
          "another Effects with restitution and speculative_contacts has the body; allowed: one such Effects for each world, or "
          "remove_body there first");
    }
    has_ours = true;
    if (snGeomSetLookAhead(geom, ode::to_real(time)) == 0) throw std::invalid_argument(snLastError());
    if (impacts) ours.set_impacts(impacts);
  });
  if (!has_ours) throw std::invalid_argument("the body has no geom made by snCreate…, but must have one");
}

}  // namespace

struct Effects::State {
  State(const std::vector<Effect>& effects, double duration, Solver solver)
      : list(validated(effects, solver)),
        step(ode::require_positive("step", duration, "s")),
        pair_materials(list, solver),
        forces(list, step),
        is_speculative(has<SpeculativeContacts>(list)),
        looks_ahead(is_speculative || solver == Solver::Stepper),
        speculative(step, has<Restitution>(list), pair_materials),
        impacts(is_speculative && has<Restitution>(list) ? std::make_shared<char>() : nullptr) {}

  /// Runs `work` and, if times are measured, adds its time to the effect's total.
  template <typename Work>
  void timed(EffectIndex effect, const Work& work) {
    if (!is_measuring) return work();
    const Clock::time_point start = Clock::now();
    work();
    seconds[effect] += std::chrono::duration<double>(Clock::now() - start).count();
  }

  int run_passes(PairMaterial& pair, std::span<dContact> contacts, dBodyID body1, dBodyID body2);
  void set_up_ahead(PairMaterial& pair, std::span<dContact> ahead, dBodyID body1, dBodyID body2);

  std::vector<Effect> list;
  double step;
  PairMaterials pair_materials;
  BodyForces forces;
  bool is_speculative;
  bool looks_ahead;
  SpeculativeSetup speculative;
  std::shared_ptr<const void> impacts;  // stands for this in geoms; null without impacts
  bool is_measuring = false;
  std::array<double, std::variant_size_v<Effect::variant>> seconds{};
  std::array<unsigned long long, std::variant_size_v<Effect::variant>> visits{};
};

// Runs the passes on each region of contact, and moves the contacts to attach to the front.
int Effects::State::run_passes(PairMaterial& pair, std::span<dContact> contacts, dBodyID body1, dBodyID body2) {
  std::size_t kept = 0;
  for (std::size_t first = 0, end = 0; first < contacts.size(); first = end) {
    // Colliders usually list the contacts of a region one after the other, but the contacts of a mesh may be interleaved.
    end = first + move_to_front(contacts.subspan(first),
                                [lead = contacts[first]](const dContact& contact) { return is_same_region(lead, contact); });
    Patch patch{contacts.subspan(first, end - first), step, static_cast<int>(end - first), body1, body2};
    for (const Pass& pass : pair.passes) timed(pass.effect, [&] { pass.run(pair, patch); });
    pair.coarse += static_cast<unsigned long long>(patch.coarse);
    for (int k = 0; k < patch.kept; ++k, ++kept) {
      const std::size_t from = first + static_cast<std::size_t>(k);
      if (from != kept) std::swap(contacts[from], contacts[kept]);
    }
  }
  return static_cast<int>(kept);
}

void Effects::State::set_up_ahead(PairMaterial& pair, std::span<dContact> ahead, dBodyID body1, dBodyID body2) {
  Patch patch{ahead, step, static_cast<int>(ahead.size()), body1, body2};
  for (const Pass& pass : pair.passes) {
    if (pass.acts_ahead) timed(pass.effect, [&] { pass.run(pair, patch); });
  }
  pair.ahead += ahead.size();
}

Effects::Effects(const std::vector<Effect>& list, double step) : Effects(list, step, Solver::QuickStep) {}
Effects::Effects(const std::vector<Effect>& list, double step, Solver solver)
    : state_(std::make_unique<State>(list, step, solver)) {}
Effects::~Effects() = default;
Effects::Effects(Effects&&) noexcept = default;
Effects& Effects::operator=(Effects&&) noexcept = default;

void Effects::set_up(dWorldID world) const {
  for (const Effect& effect : state_->list) write_to(world, effect, state_->step);
}

int Effects::set_up_contacts(std::span<dContact> contacts, Material material1, Material material2) {
  if (contacts.empty()) return 0;
  const dContactGeom& geom = contacts.front().geom;
  return set_up_contacts(contacts, Side{material1, dGeomGetBody(geom.g1)}, Side{material2, dGeomGetBody(geom.g2)});
}

int Effects::set_up_contacts(std::span<dContact> contacts, const Side& side1, const Side& side2) {
  PairMaterial& pair = state_->pair_materials.of(side1.material, side2.material);
  dSurfaceParameters surface = pair.surface;
  // A correction of the overlap at an impact would throw the bodies back.
  if (pair.is_speculative && !contacts.empty() && ode::looks_ahead(contacts.front().geom) &&
      !state_->speculative.lets_in(pair, side1.body, side2.body)) {
    ode::correct_leftover(surface);
  }
  for (dContact& contact : contacts) contact.surface = surface;
  const std::span<dContact> touching =
      contacts.first(move_to_front(contacts, [](const dContact& contact) { return !(contact.geom.depth < 0); }));
  const std::span<dContact> ahead = contacts.subspan(touching.size());
  int kept = pair.passes.empty() ? static_cast<int>(touching.size()) : state_->run_passes(pair, touching, side1.body, side2.body);
  if (pair.takes_ahead && !ahead.empty()) {
    state_->set_up_ahead(pair, ahead, side1.body, side2.body);
    // No pass has left out a touching contact: only the pass of a spring does, and contacts with a spring are not speculative.
    kept += static_cast<int>(ahead.size());
  }
  if (state_->is_speculative) {
    const auto attached = contacts.first(static_cast<std::size_t>(kept));
    state_->timed(index_of<SpeculativeContacts>(), [&] { state_->speculative.set_up(pair, attached, side1, side2); });
  }
  pair.contacts += static_cast<unsigned long long>(kept);
  return kept;
}

bool Effects::visits_bodies() const { return !state_->forces.is_empty() || state_->impacts != nullptr; }

void Effects::add_body(dBodyID body) {
  if (state_->looks_ahead) look_ahead(body, state_->step, state_->impacts);
  if (!state_->forces.is_empty()) state_->forces.add(body);
}

void Effects::remove_body(dBodyID body) {
  for_ours(body, [&](dGeomID /*geom*/, ode::Body& ours) {
    if (ours.impacts() == state_->impacts) ours.set_impacts(nullptr);
  });
  state_->forces.remove(body);
  state_->speculative.remove(body);
}

void Effects::apply_forces() {
  state_->speculative.resolve();
  for (const BodyForces::Listed& pass : state_->forces.passes()) {
    state_->timed(pass.effect, [&] { state_->visits[pass.effect] += (state_->forces.*pass.run)(); });
  }
}

void Effects::measure() { state_->is_measuring = true; }

std::vector<Cost> Effects::costs() const {
  std::vector<Cost> costs = {{.name = "rigid_contact"}};
  for (const PairMaterial& pair : state_->pair_materials.all()) costs.front().contacts += pair.contacts;
  costs.front().rows = costs.front().contacts;
  for (EffectIndex index = 0; index < std::variant_size_v<Effect::variant>; ++index) {
    const bool is_listed = std::ranges::any_of(state_->list, [&](const Effect& effect) { return effect.index() == index; });
    if (!is_listed) continue;
    Cost cost{.name = descriptions()[index].name, .bodies = state_->visits[index], .seconds = state_->seconds[index]};
    for (const PairMaterial& pair : state_->pair_materials.all()) {
      if (index == index_of<SpeculativeContacts>()) cost.contacts += pair.ahead;
      if (std::ranges::find(pair.listed, index) == pair.listed.end()) continue;
      cost.contacts += pair.contacts;
      cost.rows += pair.contacts * static_cast<unsigned long long>(pair.rows[index]);
      if (index == pair.spring) cost.coarse += pair.coarse;
    }
    costs.push_back(cost);
  }
  return costs;
}

}  // namespace supernormal::effects
