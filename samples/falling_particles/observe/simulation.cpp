#include "simulation.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include "base/archive.hpp"
#include "world/placement.hpp"

namespace falling_particles {
namespace {

using supernormal::effects::Cost;

constexpr std::array kCounts = {&snStatistics::queries_cold,          &snStatistics::queries_warm,
                                &snStatistics::evaluations_cold,      &snStatistics::evaluations_warm,
                                &snStatistics::closed_forms,          &snStatistics::contacts,
                                &snStatistics::not_converged,         &snStatistics::stalled,
                                &snStatistics::out_of_evaluations,    &snStatistics::diverged,
                                &snStatistics::contacts_not_converged};
static_assert(sizeof(snStatistics) == kCounts.size() * sizeof(snCount));

}  // namespace

Watches::Watches(World& world, const Scene& scene, Random& random) : leaks(world), energy(world, scene) {
  if (const Hopper* hopper = std::get_if<Hopper>(&scene.container)) discharge.emplace(world, *hopper, random);
  if (scene.compression) compressor.emplace(world, *world.cell(), *scene.compression, scene.time.duration);
}

void Watches::after_step(double time, const Stepper& stepper) {
  leaks.after_step(time);
  energy.after_step();
  if (discharge) discharge->after_step(time);
  if (compressor) compressor->after_step(time, stepper.contact_geoms());
}

/// The saved bytes. The world is read first, since the other members need it.
struct Simulation::Saved {
  explicit Saved(const std::string& bytes) : reader(bytes) { reader(world); }
  Reader reader;
  WorldState world;
};

Simulation::Simulation(const Scene& scene, int threads)
    : random(scene.seed),
      world(scene, place(scene, random)),
      stepper(world, scene, threads),
      watches(world, scene, random),
      population(world, scene) {
  snResetStatistics();
}

Simulation::Simulation(const Scene& scene, int threads, const std::string& saved) : Simulation(scene, threads, Saved(saved)) {}

Simulation::Simulation(const Scene& scene, int threads, Saved&& saved)
    : random(scene.seed),
      world(scene, World::GoOn{}, saved.world),
      stepper(world, scene, threads),
      watches(world, scene, random),
      population(world, scene) {
  Reader& reader = saved.reader;
  reader(random, stepper, watches, population);
  for (const auto count : kCounts) reader(statistics_before_.*count);
  effect_costs_before_ = world.effects().costs();
  for (Cost& cost : effect_costs_before_) reader(cost.rows, cost.contacts, cost.coarse, cost.bodies, cost.seconds);
  snResetStatistics();
}

void Simulation::advance(double now) {
  watches.energy.exchange(population.before_step(now));
  stepper.step();
  watches.after_step(now, stepper);
}

std::string Simulation::save_for(const std::vector<supernormal::effects::Effect>& effects) const {
  Writer writer;
  writer(world.save(), random, stepper, watches, population);
  const snStatistics counts = statistics();
  for (const auto count : kCounts) writer(counts.*count);
  const std::vector<Cost> known = effect_costs();
  for (Cost cost : supernormal::effects::Effects(effects, world.scene().time.step).costs()) {
    const auto before = std::ranges::find(known, std::string_view(cost.name), &Cost::name);
    if (before != known.end()) cost = *before;
    writer(cost.rows, cost.contacts, cost.coarse, cost.bodies, cost.seconds);
  }
  return writer.bytes();
}

snStatistics Simulation::statistics() const {
  snStatistics sum;
  snGetStatistics(&sum);
  for (const auto count : kCounts) sum.*count += statistics_before_.*count;
  return sum;
}

std::vector<Cost> Simulation::effect_costs() const {
  std::vector<Cost> costs = world.effects().costs();
  for (std::size_t i = 0; i < effect_costs_before_.size(); ++i) {
    const Cost& before = effect_costs_before_[i];
    costs[i].rows += before.rows;
    costs[i].contacts += before.contacts;
    costs[i].coarse += before.coarse;
    costs[i].bodies += before.bodies;
    costs[i].seconds += before.seconds;
  }
  return costs;
}

}  // namespace falling_particles
