#include "feeding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/interval.hpp"

namespace falling_particles {
namespace {

constexpr int kTries = 64;  // places to try for a grain in a step: in a region that is free to a tenth, all fail once in 800 cases
constexpr double kRounding = 1e-9;  // of the due amount: times are rounded multiples of a step

std::string in_brackets(const Point& p) { return "[" + shortest(p[0]) + ", " + shortest(p[1]) + ", " + shortest(p[2]) + "] m"; }

}  // namespace

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

}  // namespace falling_particles
