// The measurement coordination: contacts per grain.

#include <algorithm>
#include <array>
#include <vector>

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

constexpr std::size_t kMostCounted = 16;  // grains with this many contacts or more are counted in one column

/// For each grain, the grains that touch it by force-bearing contacts. Its own index stands for a wall.
using Neighbours = std::vector<std::vector<std::size_t>>;

Neighbours neighbours_of(const Sample& sample, bool counts_walls) {
  const std::vector<Grain>& grains = sample.world.grains();
  Neighbours neighbours(grains.size());
  for (const PairContact& contact : sample.contacts) {
    if (!contact.bears_force()) continue;
    const auto one = static_cast<std::size_t>(contact.grain1 - grains.data());
    if (contact.grain2 == nullptr) {
      if (counts_walls) neighbours[one].push_back(one);
      continue;
    }
    const auto two = static_cast<std::size_t>(contact.grain2 - grains.data());
    neighbours[one].push_back(two);
    neighbours[two].push_back(one);
  }
  return neighbours;
}

/// Removes grains with fewer contacts than `least`, together with their contacts, until none is left. Returns whether each grain
/// was removed. `contacts` becomes the number of remaining contacts of each grain.
std::vector<bool> find_rattlers(const Neighbours& neighbours, std::size_t least, std::vector<std::size_t>& contacts) {
  std::vector<bool> is_rattler(neighbours.size(), false);
  std::vector<std::size_t> waiting;
  const auto take = [&](std::size_t index) {
    if (is_rattler[index] || contacts[index] >= least) return;
    is_rattler[index] = true;
    waiting.push_back(index);
  };
  for (std::size_t index = 0; index < neighbours.size(); ++index) take(index);
  while (!waiting.empty()) {
    const std::size_t gone = waiting.back();
    waiting.pop_back();
    for (const std::size_t other : neighbours[gone]) {
      if (other == gone || is_rattler[other]) continue;
      --contacts[other];
      take(other);
    }
  }
  return is_rattler;
}

std::string coordination_columns() {
  std::string text = "time_s,grains,mean,rattlers,mean_without_rattlers";
  for (std::size_t k = 0; k < kMostCounted; ++k) text += ",grains_with_" + std::to_string(k);
  return text + ",grains_with_" + std::to_string(kMostCounted) + "_or_more";
}

std::optional<double> mean_of(std::size_t sum, std::size_t count) {
  return count == 0 ? std::nullopt : std::optional(static_cast<double>(sum) / static_cast<double>(count));
}

void measure_coordination(const Sample& sample, TableText& table, const SamplingRegion& region, bool counts_walls,
                          std::size_t least) {
  const Neighbours neighbours = neighbours_of(sample, counts_walls);
  std::vector<std::size_t> left;
  left.reserve(neighbours.size());
  for (const auto& of_grain : neighbours) left.push_back(of_grain.size());
  const std::vector<bool> is_rattler = find_rattlers(neighbours, least, left);
  const Bounds bounds = region.bounds(sample.world);
  std::array<std::size_t, kMostCounted + 1> histogram{};
  std::size_t grains = 0, contacts = 0, rattlers = 0, lasting = 0;
  for (std::size_t index = 0; index < neighbours.size(); ++index) {
    const Grain& grain = sample.world.grains()[index];
    if (!grain.is_present() || !bounds.contains(place_of(grain, sample.world))) continue;
    ++grains;
    contacts += neighbours[index].size();
    ++histogram[std::min(neighbours[index].size(), kMostCounted)];
    if (is_rattler[index]) {
      ++rattlers;
    } else {
      lasting += left[index];
    }
  }
  table.add(sample.time).add(grains).add(mean_of(contacts, grains));
  table.add(rattlers).add(mean_of(lasting, grains - rattlers));
  for (const std::size_t count : histogram) table.add(count);
  table.end_line();
}

}  // namespace

MeasurementKind coordination_kind() {
  constexpr std::int64_t kMostNeeded = 20;
  constexpr std::size_t kIsostaticSpheres = 4;  // frictionless spheres, in three dimensions
  return {.name = "coordination",
          .measures = "the number of force-bearing contacts of a grain, and rattlers",
          .parameters = {{"lower, upper", "m, corners of a box that holds the grains' centres; without them everywhere"},
                         {"walls", "true or false, whether contacts with walls count; true without it"},
                         {"least", "1 to 20, contacts without which a grain is a rattler; 4 without it (frictionless spheres)"}},
          .columns = "time, grains, mean, rattlers, mean without rattlers, number of grains with 0, 1, ... contacts",
          .source = "O'Hern et al., Phys. Rev. E 68 (2003) 011306: rattlers are taken away until none is left",
          .needs_contacts = true,
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const SamplingRegion region(table, scene, SamplingRegion::Without::Everywhere);
            const bool walls = !table.has("walls") || table.boolean("walls");
            const std::size_t least =
                table.has("least") ? static_cast<std::size_t>(table.integer("least", 1, kMostNeeded)) : kIsostaticSpheres;
            return lines_of(coordination_columns(), [=](const Sample& sample, TableText& lines) {
              measure_coordination(sample, lines, region, walls, least);
            });
          },
          .plotted = {"mean", "mean_without_rattlers"},
          .plot_label = "contacts per grain"};
}

}  // namespace falling_particles
