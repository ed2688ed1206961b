#include "list_population.hpp"

namespace falling_particles {

std::string list_population() {
  return R"([[feeder]]
  parameters  name: letters, digits, _ and -
              corner, size: m, of the region in which grains come wherever they touch nothing, wider than any of them
              grains_per_second or kg_per_second: in (0, 1e9]
              total_grains or total_kg: in (0, 1e9], after which it ends; endless without it
              from, until: s; the whole run without them
              velocity: m/s, of grains that come, each in [-1000, 1000]; 0 without it
              patience: s, in [0, 3600], for which the region may be too full for the rate before the run ends; 1 without it
              fractions_of: number or mass, of [[feeder.grain]]; number without it
  cost        a look at the neighbours of each grain that comes
[[feeder.grain]]
  parameters  name: a kind of the scene; fraction: in (0, 1], which sum to 1; without any, as the counts of the scene's grains
[[sink]]
  parameters  name: letters, digits, _ and -
              corner, size: m, of a box; or point, normal: of a plane, below which it is; it takes grains whose centre is inside
  cost        a look at each grain in a step
)";
}

}  // namespace falling_particles
