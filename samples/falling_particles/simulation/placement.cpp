#include "placement.hpp"

#include <algorithm>
#include <utility>

#include "lattice.hpp"

namespace falling_particles {
namespace {

std::vector<std::size_t> shuffled_kinds(const Scene& scene, Random& random) {
  std::vector<std::size_t> kinds;
  for (std::size_t kind = 0; kind < scene.grains.size(); ++kind) {
    kinds.insert(kinds.end(), static_cast<std::size_t>(scene.grains[kind].count), kind);
  }
  for (std::size_t i = kinds.size(); i > 1; --i) std::swap(kinds[i - 1], kinds[random.below(i)]);  // Fisher-Yates
  return kinds;
}

/// Scatters grains like the points of an ideal gas: they overlap, and are pushed apart in the first steps.
std::vector<Placement> scatter(const Scene& scene, double side, Random& random) {
  std::vector<Placement> placements;
  for (const std::size_t kind : shuffled_kinds(scene, random)) {
    Placement placement{kind, {}, {}};
    for (double& x : placement.position) x = side * random.uniform();
    placement.quaternion = random.rotation();
    placements.push_back(placement);
  }
  return placements;
}

}  // namespace

std::vector<Placement> place(const Scene& scene, Random& random) {
  if (const Periodic* periodic = std::get_if<Periodic>(&scene.container)) return scatter(scene, periodic->side, random);
  Lattice lattice(scene);
  std::vector<Placement> placements;
  for (const std::size_t kind : shuffled_kinds(scene, random)) {
    const std::array<std::size_t, 3> index = lattice.next();
    // A grain may stand anywhere in its cell as long as its own bounding sphere is inside.
    const double own_radius = scene.grains[kind].grain.bounding_radius();
    Placement placement{kind, lattice.corner(), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double size = lattice.cell()[axis];
      const double room = std::max(0.0, size - 2 * own_radius);
      placement.position[axis] += static_cast<double>(index[axis]) * size + own_radius + room * random.uniform();
    }
    placement.quaternion = random.rotation();
    placements.push_back(placement);
  }
  return placements;
}

}  // namespace falling_particles
