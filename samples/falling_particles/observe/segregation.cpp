// The measurement segregation: the mixing of two kinds of grains.

#include <vector>

#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

struct CellCount {
  double first = 0;
  double both = 0;
};

class Segregation final : public Measurement {
 public:
  Segregation(const SamplingRegion& region, const CellCounts& cells, std::vector<std::string> grains)
      : region_(region), cells_(cells), grains_(std::move(grains)) {}

  std::string columns() const override {
    return "time_s,grains,occupied_cells,fraction,variance,variance_segregated,variance_random,lacey";
  }

  void measure(const Sample& sample, TableText& table) const override {
    const Bounds bounds = region_.bounds(sample.world);
    std::vector<CellCount> cells(number_of(cells_));
    CellCount all;
    for (const Grain& grain : sample.world.present()) {
      const bool is_first = grain.kind->name == grains_[0];
      if (!is_first && grain.kind->name != grains_[1]) continue;
      const auto cell = cell_of(place_of(grain, sample.world), bounds, cells_);
      if (!cell) continue;
      for (CellCount* count : {&cells[*cell], &all}) {
        count->both += 1;
        if (is_first) count->first += 1;
      }
    }
    write(sample.time, cells, all, table);
  }

 private:
  static void write(double time, const std::vector<CellCount>& cells, const CellCount& all, TableText& table) {
    const double fraction = all.both > 0 ? all.first / all.both : 0;
    double occupied = 0;
    double variance = 0;
    for (const CellCount& cell : cells) {
      if (cell.both == 0) continue;
      ++occupied;
      const double excess = cell.first / cell.both - fraction;
      variance += cell.both * excess * excess / all.both;
    }
    const double segregated = fraction * (1 - fraction);
    table.add(time).add(static_cast<std::size_t>(all.both)).add(static_cast<std::size_t>(occupied));
    if (segregated == 0 || occupied >= all.both) {  // only one kind, or as many cells as grains, for which the index is undefined
      constexpr int kOtherColumns = 5;
      table.blank(kOtherColumns).end_line();
      return;
    }
    const double random = segregated * (occupied - 1) / (all.both - 1);
    table.add(fraction).add(variance).add(segregated).add(random).add((segregated - variance) / (segregated - random)).end_line();
  }

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
              table.fail("grains", table.full_name("grains") + " has " + std::to_string(grains.size()) + " names; allowed: two");
            }
            const SamplingRegion region(table, scene, SamplingRegion::Without::Refused);
            const CellCounts cells = read_cells(table);
            return [=](const World&) { return std::make_unique<Segregation>(region, cells, grains); };
          },
          .plotted = {"lacey"},
          .plot_label = "Lacey's index"};
}

}  // namespace falling_particles
