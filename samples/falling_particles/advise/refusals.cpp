#include "refusals.hpp"

#include <supernormal/supernormal.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "world/placement.hpp"

namespace falling_particles {
namespace {

/// Refuses grains of the lattice that start inside a part.
void refuse_start_in_parts(const World& world) {
  const Scene& scene = world.scene();
  std::vector<std::pair<dGeomID, dGeomID>> pairs;
  world.name_wall_pairs(&pairs, [](void* data, dGeomID g1, dGeomID g2) {
    static_cast<std::vector<std::pair<dGeomID, dGeomID>>*>(data)->emplace_back(g1, g2);
  });
  for (const auto& [geom, wall] : pairs) {
    const Wall* part = world.walls().wall_of(wall);
    if (part == nullptr || !part->is_part()) continue;
    snProximity proximity;
    if (snGeomProximity(geom, wall, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
    const Grain& grain = *grain_of(geom);
    constexpr double kRounding = 1e-6;  // of the smallest half-axis
    if (!(proximity.gap < -kRounding * grain.smallest_half_axis())) continue;
    const auto [x, y, z] = grain.position();
    throw InputError(scene.called + ": grain " + std::to_string(world.index_of(grain)) + " (" + grain.kind->name + ") starts at [" +
                     rounded(x, 6) + ", " + rounded(y, 6) + ", " + rounded(z, 6) + "] m, " + rounded(-proximity.gap) +
                     " m deep in " + part->called() + "; allowed: walls that leave the start of the grains free");
  }
}

}  // namespace

void refuse_bad_start(const Scene& scene) {
  refuse_meetings(scene);
  if (!scene.start && scene.bonds.empty() && scene.parts().empty()) return;
  Random random(scene.seed);
  const World world(scene, place(scene, random));
  scene.start ? refuse_bad_state(world) : refuse_start_in_parts(world);
  if (!scene.bonds.empty()) refuse_bad_bonds(world);
  refuse_bad_flights(world);
}

}  // namespace falling_particles
