// The measurement segregation: the mixing of two kinds of grains.

#include <vector>

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

class Segregation final : public Measurement {
 public:
  Segregation(const SamplingRegion& region, const CellCounts& cells, std::vector<std::string> grains)
      : region_(region), cells_(cells), grains_(std::move(grains)) {}

  std::string columns() const override { return std::string("time_s,") + LaceyGrid::kColumns; }

  void measure(const Sample& sample, TableText& table) const override {
    const Bounds bounds = region_.bounds(sample.world);
    LaceyGrid grid(number_of(cells_));
    for (const Grain& grain : sample.world.present()) {
      const bool is_first = grain.kind->name == grains_[0];
      if (!is_first && grain.kind->name != grains_[1]) continue;
      if (const auto cell = cell_of(place_of(grain, sample.world), bounds, cells_)) grid.add(*cell, is_first);
    }
    table.add(sample.time);
    grid.write(table);
    table.end_line();
  }

 private:
  SamplingRegion region_;
  CellCounts cells_;
  std::vector<std::string> grains_;
};

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
            return [=](const World&) { return std::make_unique<Segregation>(region, cells, grains); };
          },
          .plotted = {"lacey"},
          .plot_label = "Lacey's index"};
}

}  // namespace falling_particles
