// The measurements mixing and segregation: Lacey's index of grains from the two sides of a plane, and of two kinds.

#include <cstdint>
#include <vector>

#include "base/archive.hpp"
#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

constexpr const char* kLaceyColumns = "time_s,grains,occupied_cells,fraction,variance,variance_segregated,variance_random,lacey";

/// The grains of two groups in the cells of a grid, for M = (s0^2 - s^2) / (s0^2 - sr^2), by number. s^2 is the variance of the
/// first group's fraction over the cells with grains, weighted by their grains; s0^2 = p (1 - p) is the variance of groups apart;
/// sr^2 = p (1 - p) (K - 1) / (N - 1) is the mean of s^2 for N grains in random order in K cells. P. M. C. Lacey, Developments in
/// the theory of particle mixing, J. Appl. Chem. 4 (1954) 257-268.
class LaceyGrid {
 public:
  explicit LaceyGrid(std::size_t cells) : cells_(cells) {}

  /// `cell`: below the number of cells.
  void add(std::size_t cell, bool is_first) {
    for (Count* count : {&cells_[cell], &all_}) {
      count->both += 1;
      if (is_first) count->first += 1;
    }
  }

  /// The line of a sample. All but two numbers are empty if there is only one group, or no cell with two grains.
  void write(double time, TableText& table) const {
    const double fraction = all_.both > 0 ? all_.first / all_.both : 0;
    double occupied = 0;
    double variance = 0;
    for (const Count& cell : cells_) {
      if (cell.both == 0) continue;
      ++occupied;
      const double excess = cell.first / cell.both - fraction;
      variance += cell.both * excess * excess / all_.both;
    }
    const double segregated = fraction * (1 - fraction);
    table.add(time).add(static_cast<std::size_t>(all_.both)).add(static_cast<std::size_t>(occupied));
    if (segregated == 0 || occupied >= all_.both) {  // only one group, or as many cells as grains, for which the index is undefined
      constexpr int kOtherColumns = 5;
      return table.blank(kOtherColumns).end_line();
    }
    const double random = segregated * (occupied - 1) / (all_.both - 1);
    table.add(fraction).add(variance).add(segregated).add(random).add((segregated - variance) / (segregated - random)).end_line();
  }

 private:
  struct Count {
    double first = 0;
    double both = 0;
  };
  std::vector<Count> cells_;
  Count all_;
};

class Mixing final : public Measurement {
 public:
  Mixing(const SamplingRegion& region, const CellCounts& cells, const AxisPlane& plane)
      : region_(region), cells_(cells), plane_(plane) {}

  std::string columns() const override { return kLaceyColumns; }

  void begin(const Sample& sample) override { label_new(sample.world, place_of); }
  void follow(const Sample& sample) override { label_new(sample.world, place_before); }

  void measure(const Sample& sample, TableText& table) const override {
    const Bounds bounds = region_.bounds(sample.world);
    LaceyGrid grid(number_of(cells_));
    for (const Grain& grain : sample.world.present()) {
      const std::size_t index = sample.world.index_of(grain);
      if (index >= is_below_.size()) continue;
      if (const auto cell = cell_of(place_of(grain, sample.world), bounds, cells_)) grid.add(*cell, is_below_[index] != 0);
    }
    grid.write(sample.time, table);
  }

  std::string save() const override { return to_bytes(is_below_); }
  void restore(const std::string& memory) override { Reader{memory}(is_below_); }

 private:
  /// Grains that were removed before they had a label are in no sample.
  void label_new(const World& world, Vector3 (*place)(const Grain&, const World&)) {
    const std::vector<Grain>& grains = world.grains();
    for (std::size_t i = is_below_.size(); i < grains.size(); ++i) {
      is_below_.push_back(grains[i].is_present() && place(grains[i], world)[static_cast<int>(plane_.axis)] < plane_.at ? 1 : 0);
    }
  }

  SamplingRegion region_;
  CellCounts cells_;
  AxisPlane plane_;
  std::vector<std::uint8_t> is_below_;  // of each grain, where it was first seen
};

void measure_segregation(const Sample& sample, TableText& table, const SamplingRegion& region, const CellCounts& cells,
                         const std::vector<std::string>& kinds) {
  const Bounds bounds = region.bounds(sample.world);
  LaceyGrid grid(number_of(cells));
  for (const Grain& grain : sample.world.present()) {
    const bool is_first = grain.kind->name == kinds[0];
    if (!is_first && grain.kind->name != kinds[1]) continue;
    if (const auto cell = cell_of(place_of(grain, sample.world), bounds, cells)) grid.add(*cell, is_first);
  }
  grid.write(sample.time, table);
}

}  // namespace

MeasurementKind mixing_kind() {
  constexpr double kFarthest = 1e6;  // m
  return {
      .name = "mixing",
      .measures = "Lacey's mixing index of the grains that began on the two sides of a plane: 0 apart, 1 mixed at random",
      .parameters = {{"axis", "x, y or z, at right angles to the plane"},
                     {"at",
                      "m, of the plane along the axis; grains have the side where they are at `from`, or where they are inserted"},
                     {"lower, upper", "m, corners of the grid; without them all of a periodic cell"},
                     {"cells", "three whole numbers from 1 to 1000, along x, y and z; the index depends on their size"}},
      .columns =
          "time, grains, cells with grains, fraction of the grains from below the plane, its variance, the variance of groups "
          "apart, the variance of random order, index",
      .source = "Lacey, J. Appl. Chem. 4 (1954) 257; cells are weighted by their grains",
      .follows = true,
      .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
        const AxisPlane plane{read_axis(table, "axis"), table.number("at", Interval::closed(-kFarthest, kFarthest, "m"))};
        const SamplingRegion region(table, scene, SamplingRegion::Without::Refused);
        const CellCounts cells = read_cells(table);
        return [=](const World&) { return std::make_unique<Mixing>(region, cells, plane); };
      },
      .plotted = {"lacey"},
      .plot_label = "Lacey's index"};
}

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
            return lines_of(kLaceyColumns, [=](const Sample& sample, TableText& lines) {
              measure_segregation(sample, lines, region, cells, grains);
            });
          },
          .plotted = {"lacey"},
          .plot_label = "Lacey's index"};
}

}  // namespace falling_particles
