#include "sizes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace falling_particles {
namespace {

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
