#include "population.hpp"

#include <algorithm>

namespace falling_particles {
namespace {

Amount present_in(const World& world) {
  Amount amount;
  for (const Grain& grain : world.present()) amount.add(grain.mass.mass);
  return amount;
}

}  // namespace

Population::Population(World& world, const Scene& scene)
    : world_(world),
      scene_(scene),
      taken_(scene.sinks.size(), std::vector<Amount>(scene.kinds.size())),
      at_start_(present_in(world)) {
  for (const Feeder& feeder : scene.feeders) feeders_.emplace_back(feeder, world, scene.seed, feeders_.size());
}

double Population::before_step(double end) { return take() + feed(end); }

double Population::take() {
  double energy = 0;
  if (scene_.sinks.empty()) return energy;
  std::vector<std::size_t> inside;
  for (const Grain& grain : world_.present()) {
    const auto contains = [&](const Sink& sink) { return sink.contains(world_.place_of(grain)); };
    const auto sink = std::ranges::find_if(scene_.sinks, contains);
    if (sink == scene_.sinks.end()) continue;
    energy -= energy_of(grain, scene_);
    taken_[static_cast<std::size_t>(sink - scene_.sinks.begin())][scene_.kind_of(*grain.kind)].add(grain.mass.mass);
    inside.push_back(world_.index_of(grain));
  }
  for (const std::size_t index : inside) world_.remove(index);
  return energy;
}

double Population::feed(double end) {
  double energy = 0;
  if (feeders_.empty()) return energy;
  if (PeriodicCell* cell = world_.cell()) cell->place_images();
  for (Feeding& feeding : feeders_) {
    for (const std::size_t index : feeding.feed(end)) energy += energy_of(world_.grains()[index], scene_);
  }
  return energy;
}

Amount Population::fed() const {
  Amount sum;
  for (const Feeding& feeding : feeders_) sum += feeding.fed();
  return sum;
}

Amount Population::taken() const {
  Amount sum;
  for (const std::vector<Amount>& kinds : taken_) {
    for (const Amount& amount : kinds) sum += amount;
  }
  return sum;
}

Amount Population::present() const { return present_in(world_); }

}  // namespace falling_particles
