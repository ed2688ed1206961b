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

double Scene::smallest_half_axis() const {
  double smallest = INFINITY;
  for (const GrainCount& kind : grains) smallest = std::min(smallest, kind.grain.smallest_half_axis());
  return smallest;
}

double Scene::largest_bounding_radius() const {
  double largest = 0;
  for (const GrainCount& kind : grains) largest = std::max(largest, kind.grain.bounding_radius());
  return largest;
}

double Scene::smallest_cell() const { return 2 * largest_bounding_radius() * (1 + drop.gap); }

}  // namespace falling_particles
