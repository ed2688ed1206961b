// The measurement segregation: the mixing of two kinds of grains.

#include <vector>

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

void measure_segregation(const Sample& sample, TableText& table, const SamplingRegion& region, const CellCounts& cells,
                         const std::vector<std::string>& kinds) {
  const Bounds bounds = region.bounds(sample.world);
  LaceyGrid grid(number_of(cells));
  for (const Grain& grain : sample.world.present()) {
    const bool is_first = grain.kind->name == kinds[0];
    if (!is_first && grain.kind->name != kinds[1]) continue;
    if (const auto cell = cell_of(place_of(grain, sample.world), bounds, cells)) grid.add(*cell, is_first);
  }
  table.add(sample.time);
  grid.write(table);
  table.end_line();
}

}  // namespace

MeasurementKind segregation_kind() {
  return {.name = "segregation",
          .measures = "Lacey's mixing index of two kinds, by number: 0 apart, 1 mixed at random",
          .parameters = {{"grains", "the names of two kinds"},
                         {"lower, upper", "m, corners of the grid; without them all of a periodic cell"},
                         {"cells", "three whole numbers from 1 to 1000, along x, y and z; the index depends on their size"}},
          .columns =
              "time, grains of both kinds, cells with grains, fraction of the first kind, its variance, the variance of separated "
              "kinds, the variance of random order, index",
          .source = "Lacey, J. Appl. Chem. 4 (1954) 257; cells are weighted by their grains",
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const std::vector<std::string> grains = table.choices("grains", names_of_grains(scene));
            if (grains.size() != 2) {
              table.refuse("grains", " has " + std::to_string(grains.size()) + " names; allowed: two");
            }
            const SamplingRegion region(table, scene, SamplingRegion::Without::Refused);
            const CellCounts cells = read_cells(table);
            return lines_of(std::string("time_s,") + LaceyGrid::kColumns, [=](const Sample& sample, TableText& lines) {
              measure_segregation(sample, lines, region, cells, grains);
            });
          },
          .plotted = {"lacey"},
          .plot_label = "Lacey's index"};
}

}  // namespace falling_particles
