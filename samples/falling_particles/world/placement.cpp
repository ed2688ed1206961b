#include "placement.hpp"

#include <algorithm>
#include <utility>

#include "model/lattice.hpp"

namespace falling_particles {
namespace {

/// The grains in random order, not yet placed.
std::vector<Placement> shuffled_grains(const Scene& scene, Random& random) {
  std::vector<Placement> grains;
  for (std::size_t kind = 0; kind < scene.kinds.size(); ++kind) {
    const auto count = static_cast<std::size_t>(scene.kinds[kind].count);
    for (std::size_t i = 0; i < count; ++i) grains.push_back({kind, {}, {}, scene.kinds[kind].scale(i)});
  }
  for (std::size_t i = grains.size(); i > 1; --i) std::swap(grains[i - 1], grains[random.below(i)]);  // Fisher-Yates
  return grains;
}

/// Scatters grains like the points of an ideal gas. They overlap; the first steps push them apart.
std::vector<Placement> scatter(const Scene& scene, double side, Random& random) {
  std::vector<Placement> placements = shuffled_grains(scene, random);
  for (Placement& placement : placements) {
    for (double& x : placement.position) x = side * random.uniform();
    placement.quaternion = random.rotation();
  }
  return placements;
}

std::vector<Placement> placements_of(const StartState& start) {
  std::vector<Placement> placements;
  placements.reserve(start.grains.size());
  for (const StartGrain& grain : start.grains) {
    placements.push_back({grain.kind, grain.position, grain.quaternion, grain.scale, grain.velocity, grain.angular_velocity});
  }
  return placements;
}

}  // namespace

std::vector<Placement> place(const Scene& scene, Random& random) {
  if (scene.start) return placements_of(*scene.start);
  if (const Periodic* periodic = std::get_if<Periodic>(&scene.container)) return scatter(scene, periodic->side, random);
  Lattice lattice(scene);
  std::vector<double> radii;  // m, by kind
  for (const GrainCount& entry : scene.kinds) radii.push_back(entry.kind.bounding_radius());
  std::vector<Placement> placements = shuffled_grains(scene, random);
  for (Placement& placement : placements) {
    // A grain may be anywhere in its cell where its own bounding sphere is inside.
    const double own_radius = placement.scale * radii[placement.kind];
    const Lattice::Cell cell = lattice.next(own_radius);
    placement.position = lattice.corner();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double room = std::max(0.0, cell.size[axis] - 2 * own_radius);
      placement.position[axis] += cell.offset[axis] + own_radius + room * random.uniform();
    }
    placement.quaternion = random.rotation();
  }
  return placements;
}

}  // namespace falling_particles
