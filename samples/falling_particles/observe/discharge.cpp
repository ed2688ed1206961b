#include "discharge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace falling_particles {

double beverloo_mass_flow(double outlet, double grain_diameter, double bulk_density, double gravity) {
  const double effective = std::max(0.0, outlet - kBeverlooK * grain_diameter);
  return kBeverlooC * bulk_density * std::sqrt(gravity) * std::pow(effective, 2.5);
}

Discharge::Discharge(World& world, const Hopper& hopper, Random& random)
    : world_(world), hopper_(hopper), random_(random), has_passed_(world.grains().size(), false) {
  passages_.reserve(has_passed_.size());
}

void Discharge::after_step(double time) {
  if (!charge_) {
    if (time >= hopper_.opens_at) open(time);
    return;
  }
  has_passed_.resize(world_.grains().size(), false);
  for (const Grain& grain : world_.present()) {
    const std::size_t i = world_.index_of(grain);
    const Point p = grain.position();
    // A grain that comes down beside the outlet has not passed it: this is a leak (leaks.hpp).
    if (has_passed_[i] || !(p[2] < hopper_.clearance) || !hopper_.is_within(p[0], p[1], hopper_.outlet / 2)) continue;
    has_passed_[i] = true;
    passages_.push_back({time, mass() + grain.mass.mass});
  }
}

void Discharge::open(double time) {
  double mass = 0;
  double volume = 0;
  std::size_t grains = 0;
  has_passed_.resize(world_.grains().size(), false);
  for (const Grain& grain : world_.present()) {
    // A run that goes on from a state with an open outlet has grains below it.
    const bool is_below = grain.position()[2] < hopper_.clearance;
    has_passed_[world_.index_of(grain)] = is_below;
    if (is_below) continue;
    ++grains;
    mass += grain.mass.mass;
    volume += grain.volume();
  }
  const double mean_volume = volume / static_cast<double>(std::max<std::size_t>(grains, 1));
  charge_ = Charge{time, mass, std::cbrt(6 / std::numbers::pi * mean_volume), measure_bed(world_, hopper_, random_)};
  world_.open_outlet();
}

const Discharge::Passage* Discharge::find_passage(double share) const {
  const auto found = std::ranges::lower_bound(passages_, share * charge_->mass, {}, &Passage::total_mass);
  return found == passages_.end() ? nullptr : &*found;
}

std::optional<double> Discharge::mass_flow() const {
  if (!charge_) return std::nullopt;
  const Passage* from = find_passage(kSteadyFrom);
  const Passage* to = find_passage(kSteadyTo);
  // All grains of the section have passed in one step, since there are only a few. So there is no flow.
  if (to == nullptr || !(to->time > from->time)) return std::nullopt;
  return (to->total_mass - from->total_mass) / (to->time - from->time);
}

}  // namespace falling_particles
