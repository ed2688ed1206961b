// Doubts about lengths that were probably typed in another unit.

#include <algorithm>

#include "common/interval.hpp"
#include "doubts.hpp"

namespace falling_particles {

// A box that holds one grain, typed in mm, is a thousand of its grains wide.
void add_doubts_about_units(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kMillimetres = 1000;
  double widest = 0;  // m, of the grains
  for (const GrainCount& entry : scene.kinds) {
    if (scene.has_grains_of(entry)) widest = std::max(widest, entry.largest_scale() * entry.kind.sieve_size());
  }
  const Rectangle plan = plan_of(scene.container);
  const double narrower = std::min(plan.width[0], plan.width[1]);
  if (!(widest > 0 && narrower >= kMillimetres * widest)) return;
  doubts.push_back("the container is " + rounded(narrower) + " m wide, " + rounded(narrower / widest) +
                   " times the largest grain, " + rounded(widest) + " m: lengths are in m; millimetres would give this factor");
}

}  // namespace falling_particles
