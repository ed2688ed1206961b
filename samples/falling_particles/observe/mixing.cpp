// The measurement mixing: the mixing of grains from the two sides of a plane.

#include <cstdint>
#include <vector>

#include "base/archive.hpp"
#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

class Mixing final : public Measurement {
 public:
  Mixing(const SamplingRegion& region, const CellCounts& cells, const AxisPlane& plane)
      : region_(region), cells_(cells), plane_(plane) {}

  std::string columns() const override { return std::string("time_s,") + LaceyGrid::kColumns; }

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
    table.add(sample.time);
    grid.write(table);
    table.end_line();
  }

  std::string save() const override {
    Writer writer;
    writer(is_below_);
    return writer.bytes();
  }
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

}  // namespace falling_particles
