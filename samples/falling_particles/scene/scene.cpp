#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace falling_particles {

int Time::steps() const { return static_cast<int>(std::lround(duration / step)); }
int Time::steps_per_frame() const { return static_cast<int>(std::lround(frame / step)); }

const supernormal::effects::Gravity* Scene::gravity() const {
  for (const supernormal::effects::Effect& effect : effects) {
    if (const auto* gravity = std::get_if<supernormal::effects::Gravity>(&effect)) return gravity;
  }
  return nullptr;
}

int Scene::bodies() const {
  int sum = 0;
  for (const GrainCount& kind : grains) sum += kind.count;
  return sum;
}

bool Scene::has_sizes() const {
  return std::ranges::any_of(grains, [](const GrainCount& kind) { return kind.size.has_value(); });
}

double Scene::smallest_half_axis() const {
  double smallest = INFINITY;
  for (const GrainCount& kind : grains) {
    const double scale = kind.scales.empty() ? 1 : std::ranges::min(kind.scales);
    smallest = std::min(smallest, scale * kind.grain.smallest_half_axis());
  }
  return smallest;
}

double Scene::largest_bounding_radius() const {
  double largest = 0;
  for (const GrainCount& kind : grains) {
    const double scale = kind.scales.empty() ? 1 : std::ranges::max(kind.scales);
    largest = std::max(largest, scale * kind.grain.bounding_radius());
  }
  return largest;
}

double Scene::smallest_cell() const { return 2 * largest_bounding_radius() * (1 + drop.gap); }

}  // namespace falling_particles
