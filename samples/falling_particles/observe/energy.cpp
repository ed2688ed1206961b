#include "energy.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "leaks.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

using Pairs = std::vector<std::pair<dGeomID, dGeomID>>;

void append(void* pairs, dGeomID g1, dGeomID g2) { static_cast<Pairs*>(pairs)->emplace_back(g1, g2); }

double smallest_half_axis(dGeomID geom) {
  const Grain* grain = grain_of(geom);
  return grain == nullptr ? INFINITY : grain->smallest_half_axis();
}

std::array<dReal, 4> middle_of(const snProximity& proximity) {
  std::array<dReal, 4> middle{};
  for (std::size_t i = 0; i < 3; ++i) middle[i] = (proximity.point1[i] + proximity.point2[i]) / 2;
  return middle;
}

struct SizeAndMass {
  double size, mass;
};

/// m, the size of the grain, in increasing order, at which the mass passes a fraction of the whole.
double size_below(const std::vector<SizeAndMass>& grains, double share, double mass) {
  double passed = 0;
  for (const SizeAndMass& grain : grains) {
    passed += grain.mass;
    if (passed >= share * mass) return grain.size;
  }
  return grains.back().size;
}

DrawnSizes sizes_of(std::string name, std::vector<SizeAndMass> grains) {
  std::ranges::sort(grains, {}, &SizeAndMass::size);
  DrawnSizes sizes{std::move(name), grains.size()};
  const auto number = static_cast<double>(grains.size());
  for (const SizeAndMass& grain : grains) {
    sizes.mass += grain.mass;
    sizes.mean += grain.size / number;
  }
  double squares = 0;
  for (const SizeAndMass& grain : grains) squares += (grain.size - sizes.mean) * (grain.size - sizes.mean);
  if (grains.size() > 1) sizes.standard_deviation = std::sqrt(squares / (number - 1));
  sizes.smallest = grains.front().size;
  sizes.largest = grains.back().size;
  sizes.median = (grains[(grains.size() - 1) / 2].size + grains[grains.size() / 2].size) / 2;
  sizes.by_mass = {size_below(grains, 0.1, sizes.mass), size_below(grains, 0.5, sizes.mass), size_below(grains, 0.9, sizes.mass)};
  return sizes;
}

}  // namespace

Energy measure_energy(const World& world, const Scene& scene) {
  Energy energy{0, world.bonds() == nullptr ? 0 : world.bonds()->energy()};
  const auto* const gravity = scene.gravity();
  for (const Grain& grain : world.present()) {
    energy.kinetic += kinetic_energy(grain);
    if (gravity == nullptr) continue;
    const dReal* position = dBodyGetPosition(grain.body);
    for (int i = 0; i < 3; ++i) energy.potential -= grain.mass.mass * gravity->acceleration[i] * position[i];
  }
  return energy;
}

double kinetic_height(const World& world, const Scene& scene) {
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr) return 0;
  double mass = 0;
  for (const Grain& grain : world.present()) mass += grain.mass.mass;
  const double weight = mass * gravity->acceleration.norm();
  return weight > 0 ? measure_energy(world, scene).kinetic / weight : 0;
}

double largest_kinetic_energy(const World& world) {
  double largest = 0;
  for (const Grain& grain : world.present()) largest = std::max(largest, kinetic_energy(grain));
  return largest;
}

EnergyWatch::EnergyWatch(const World& world, const Scene& scene)
    : world_(world), scene_(scene), start_(measure_energy(world, scene).total()), least_(start_) {}

void EnergyWatch::exchange(double energy) {
  start_ += energy;
  least_ += energy;
}

void EnergyWatch::after_step() {
  const double now = measure_energy(world_, scene_).total();
  gained_ = std::max(gained_, now - least_);
  least_ = std::min(least_, now);
}

Overlap measure_overlap(const World& world) {
  Pairs pairs;
  world.name_pairs(&pairs, append);
  const PeriodicCell* cell = world.cell();
  Overlap overlap;
  for (const auto& [g1, g2] : pairs) {
    if (world.bonds() != nullptr && world.bonds()->hide(g1, g2)) continue;
    snProximity proximity;
    if (snGeomProximity(g1, g2, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
    if (!(proximity.gap < 0)) continue;
    if (cell != nullptr && !cell->contains(middle_of(proximity).data())) continue;  // another image of this overlap is in the cell
    const double depth = -proximity.gap;
    ++overlap.pairs;
    overlap.depth = std::max(overlap.depth, depth);
    const double relative = depth / std::min(smallest_half_axis(g1), smallest_half_axis(g2));
    if (relative <= overlap.relative_to_pair) continue;
    overlap.relative_to_pair = relative;
    overlap.worst = {g1, g2};
    overlap.worst_depth = depth;
  }
  return overlap;
}

std::size_t count_outside(const World& world) {
  const Inside inside(world);
  std::size_t count = 0;
  for (const Grain& grain : world.present()) {
    if (!inside.contains(grain.position(), grain.bounding_radius())) ++count;
  }
  return count;
}

std::vector<DrawnSizes> measure_sizes(const World& world, const Scene& scene) {
  std::vector<DrawnSizes> all;
  for (const GrainCount& entry : scene.kinds) {
    if (!entry.size) continue;
    std::vector<SizeAndMass> grains;
    for (const Grain& grain : world.grains()) {
      if (grain.kind == &entry.kind) grains.push_back({grain.scale * entry.kind.sieve_size(), grain.mass.mass});
    }
    if (!grains.empty()) all.push_back(sizes_of(entry.kind.name, std::move(grains)));
  }
  return all;
}

}  // namespace falling_particles
