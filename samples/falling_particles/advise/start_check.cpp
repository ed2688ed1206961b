// The check of a state from which a scene starts.

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "observe/overlap.hpp"
#include "refusals.hpp"

namespace falling_particles {
namespace {

/// Describes the grains of a state in messages.
class StateNames {
 public:
  StateNames(const World& world, const StartState& start) : world_(world), start_(start) {}

  unsigned line_of(const Grain& grain) const { return start_.grains[world_.index_of(grain)].line; }
  static std::string name_of(const Grain& grain) { return "the " + grain.kind->name; }

  /// A wall, or a grain with its line.
  std::string name_of(dGeomID geom) const {
    if (const Wall* wall = world_.walls().wall_of(geom)) return wall->called();
    const Grain& grain = *grain_of(geom);
    return name_of(grain) + " of line " + std::to_string(line_of(grain));
  }

 private:
  const World& world_;
  const StartState& start_;
};

}  // namespace

void refuse_bad_state(const World& world) {
  const Scene& scene = world.scene();
  const StartState& start = *scene.start;
  const StateNames names(world, start);
  if (world.cell() != nullptr) world.cell()->place_images();
  const Overlap overlap = measure_overlap(world);
  if (overlap.relative_to_pair > start.overlap) {
    const bool is_wall_first = grain_of(overlap.worst[0]) == nullptr;
    const Grain& grain = *grain_of(overlap.worst[is_wall_first ? 1 : 0]);
    throw InputError(start.file.string(), names.line_of(grain),
                     StateNames::name_of(grain) + " is " + rounded(overlap.worst_depth) + " m deep in " +
                         names.name_of(overlap.worst[is_wall_first ? 0 : 1]) + ", " + rounded(overlap.relative_to_pair) +
                         " of the smallest half-axis; allowed: up to " + shortest(start.overlap) + ", start.overlap");
  }
  for (const Grain& grain : world.present()) {
    if (is_inside(scene, grain.position())) continue;
    const auto [x, y, z] = grain.position();
    throw InputError(start.file.string(), names.line_of(grain),
                     StateNames::name_of(grain) + " is at [" + shortest(x) + ", " + shortest(y) + ", " + shortest(z) +
                         "] m, outside the container, a " + kind_of(scene.container) + "; allowed: inside");
  }
}

}  // namespace falling_particles
