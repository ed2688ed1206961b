#include "population.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/interval.hpp"

namespace falling_particles {
namespace {

Amount present_in(const World& world) {
  Amount amount;
  for (const Grain& grain : world.present()) amount.add(grain.mass.mass);
  return amount;
}

constexpr int kTries = 64;  // places to try for a grain in a step: in a region that is free to a tenth, all fail once in 800 cases
constexpr double kRounding = 1e-9;  // of the due amount: times are rounded multiples of a step

std::string in_brackets(const Point& p) { return "[" + shortest(p[0]) + ", " + shortest(p[1]) + ", " + shortest(p[2]) + "] m"; }

/// A random position and orientation such that a ball of `radius` (m) lies within the region.
Placement random_place(const Region& region, std::size_t kind, double scale, double radius, Random& random) {
  Placement place{kind, {}, {}, scale};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double room = std::max(0.0, region.size[axis] - 2 * radius);
    place.position[axis] = region.corner[axis] + radius + room * random.uniform();
  }
  place.quaternion = random.rotation();
  return place;
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

Feeding::Feeding(const Feeder& feeder, World& world, std::uint64_t seed, std::uint64_t number)
    : feeder_(feeder), world_(world), state_{.random = Random(seed + 0x9e3779b97f4a7c15U * (number + 1))} {
  state_.fed.resize(feeder.mixture.size());
  candidates_.resize(feeder.mixture.size());
  choose_next();
}

const GrainKind& Feeding::kind(std::size_t i) const { return world_.scene().kinds[feeder_.mixture[i].kind].kind; }

Amount Feeding::fed() const {
  Amount sum;
  for (const Amount& amount : state_.fed) sum += amount;
  return sum;
}

/// The kind that would be most below its fraction if one more grain were fed.
std::size_t Feeding::next_kind() const {
  const Amount all = fed();
  const double whole = feeder_.fraction_of == Quantity::Of::Mass ? all.mass : static_cast<double>(all.grains) + 1;
  std::size_t most_behind = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < state_.fed.size(); ++i) {
    const double behind = feeder_.mixture[i].fraction * whole - Quantity{0, feeder_.fraction_of}.in(state_.fed[i]);
    if (behind > most) {
      most = behind;
      most_behind = i;
    }
  }
  return most_behind;
}

void Feeding::choose_next() {
  const std::size_t kind = next_kind();
  const std::optional<SizeDistribution>& size = world_.scene().kinds[feeder_.mixture[kind].kind].size;
  state_.next = {kind, size ? size->quantile(state_.random.uniform()) : 1};
}

Candidate& Feeding::candidate() {
  const auto& [index, scale] = state_.next;
  std::unique_ptr<Candidate>& last = candidates_[index];
  if (last == nullptr || last->grain().scale != scale) last = std::make_unique<Candidate>(kind(index), scale);
  return *last;
}

bool Feeding::is_due(double now) {
  Amount then = fed();
  then.add(candidate().grain().mass.mass);
  const double owed = feeder_.rate.number * (std::min(now, feeder_.until) - feeder_.from);
  const auto is_within = [&](const Quantity& limit) { return limit.in(then) <= (1 + kRounding) * limit.number; };
  return is_within({owed, feeder_.rate.of}) && (!feeder_.total || is_within(*feeder_.total));
}

std::span<const std::size_t> Feeding::feed(double now) {
  last_.clear();
  if (!is_due(now)) return last_;
  Neighbourhood neighbourhood(world_, feeder_.region);
  while (is_due(now)) {
    std::optional<Placement> place = find_place(neighbourhood);
    if (!place) {
      check_timeout(now);
      return last_;
    }
    place->velocity = feeder_.velocity;
    last_.push_back(world_.insert(*place));
    const Grain& grain = world_.grains()[last_.back()];
    for (const dGeomID geom : grain.geoms()) neighbourhood.add(geom);
    state_.fed[state_.next.kind].add(grain.mass.mass);
    choose_next();
  }
  state_.behind_since.reset();
  return last_;
}

std::optional<Placement> Feeding::find_place(const Neighbourhood& neighbourhood) {
  const Candidate& next = candidate();
  const double radius = next.grain().bounding_radius();
  for (int i = 0; i < kTries; ++i) {
    const std::size_t kind = feeder_.mixture[state_.next.kind].kind;
    const Placement place = random_place(feeder_.region, kind, state_.next.scale, radius, state_.random);
    next.put(place);
    const auto is_free = [&](dGeomID geom) { return neighbourhood.is_free(geom); };
    if (std::ranges::all_of(next.geoms(), is_free)) return place;
  }
  return std::nullopt;
}

void Feeding::check_timeout(double now) {
  if (!state_.behind_since) {
    state_.behind_since = now;
    state_.when_behind = fed();
  }
  const double waited = now - *state_.behind_since;
  if (waited <= feeder_.patience) return;
  const Quantity unit{0, feeder_.rate.of};
  const double passed = (unit.in(fed()) - unit.in(state_.when_behind)) / waited;
  const char* const of = unit.of == Quantity::Of::Mass ? " kg/s" : " grains/s";
  throw std::runtime_error(
      "feeder \"" + feeder_.name + "\" has been behind its rate of " + feeder_.rate.in_words() + "/s for " + rounded(waited) +
      " s, at t = " + shortest(now) + " s: its region, " + in_brackets(feeder_.region.size) + " from " +
      in_brackets(feeder_.region.corner) + ", had room for " + rounded(passed) + of +
      " in that time; allowed: a rate that it has room for, a larger region (wider for grains that leave it downwards), a velocity "
      "that takes grains out of it sooner, free space below it, or feeder.patience above " +
      shortest(feeder_.patience) + " s");
}

Candidate::Candidate(const GrainKind& kind, double scale)
    : world_(dWorldCreate()), grain_{dBodyCreate(world_), nullptr, &kind, {}, scale} {
  grain_.geom = attach_geoms(nullptr, kind, scale, grain_.body, nullptr);
  grain_.mass = mass_of(grain_);
  geoms_ = grain_.geoms();
}

Candidate::~Candidate() {
  std::ranges::for_each(geoms_, dGeomDestroy);
  dWorldDestroy(world_);
}

Neighbourhood::Neighbourhood(const World& world, const Region& region) {
  Aabb box;
  for (std::size_t i = 0; i < 3; ++i) {
    box[2 * i] = region.corner[i];
    box[2 * i + 1] = region.corner[i] + region.size[i];
  }
  const auto add_if_near = [&](dGeomID geom) {
    if (dGeomIsEnabled(geom) != 0 && meet(aabb_of(geom), box)) geoms_.push_back(geom);
  };
  world.sweep().for_each_geom(add_if_near);
  std::ranges::for_each(world.walls().geoms(), add_if_near);
}

bool Neighbourhood::is_free(dGeomID geom) const {
  const Aabb own = aabb_of(geom);
  return std::ranges::none_of(geoms_, [&](dGeomID other) {
    if (!meet(own, aabb_of(other))) return false;
    snProximity proximity;
    if (snGeomProximity(geom, other, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
    return !(proximity.gap > 0);
  });
}

}  // namespace falling_particles
