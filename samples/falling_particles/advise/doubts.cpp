#include "doubts.hpp"

namespace falling_particles {

std::vector<std::string> doubts_about(const Scene& scene) {
  std::vector<std::string> doubts;
  for (const auto add : {add_doubts_about_step, add_doubts_about_loads, add_doubts_about_walls, add_doubts_about_springs,
                         add_doubts_about_leaks, add_doubts_about_units, add_doubts_about_meetings, add_doubts_about_bonds}) {
    add(scene, doubts);
  }
  return doubts;
}

}  // namespace falling_particles
