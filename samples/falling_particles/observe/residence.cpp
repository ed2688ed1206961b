// The measurement residence: the time that grains spend in a region.

#include <cmath>
#include <limits>
#include <vector>

#include "base/archive.hpp"
#include "measurement.hpp"
#include "region.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

/// The visits of a kind of grains to a region.
struct VisitsOfKind {
  std::size_t inside = 0;
  std::size_t entered = 0;
  std::size_t left = 0;
  std::size_t timed = 0;  // of those that left, with a known time of entry
  double mean = 0;        // s, of these
  double squares = 0;     // s^2, sum of their squared deviations from the mean (Welford 1962)

  void end(double residence) {
    ++timed;
    const double excess = residence - mean;
    mean += excess / static_cast<double>(timed);
    squares += excess * (residence - mean);
  }

  void serialize(auto& archive) { archive(inside, entered, left, timed, mean, squares); }
};

/// A visit that has ended.
struct Visit {
  std::size_t grain = 0;
  double entered = 0;  // s
  double left = 0;     // s

  void serialize(auto& archive) { archive(grain, entered, left); }
};

constexpr double kLineOfVisit = 80;  // bytes, in feeder.toml

// The rounding of a place, as a fraction of a step's way. Images that meet at a side of a cell have no gap.
constexpr double kRounding = 1e-9;

constexpr double kOutside = std::numeric_limits<double>::infinity();
constexpr double kUnknown = -std::numeric_limits<double>::infinity();

class Residence final : public Measurement {
 public:
  Residence(const World& world, const SamplingRegion& region, bool per_visit)
      : region_(region), per_visit_(per_visit), kinds_(world.scene().kinds.size()) {}

  std::string columns() const override {
    return per_visit_ ? "body,grain,scale,sieve_size_m,entered_s,left_s,residence_s"
                      : "time_s,grain,inside,entered,left,residences,mean_residence_s,deviation_s";
  }

  /// The grains of the start enter at time 0. Others that are already inside have no known time of entry.
  void begin(const Sample& sample) override {
    const Bounds bounds = region_.bounds(sample.world);
    entered_.resize(sample.world.grains().size(), kOutside);
    for (const Grain& grain : sample.world.present()) {
      if (!bounds.contains(place_of(grain, sample.world))) continue;
      entered_[sample.world.index_of(grain)] = sample.time > 0 ? kUnknown : 0;
      ++of_kind(grain, sample.world).inside;
    }
  }

  void follow(const Sample& sample) override {
    const World& world = sample.world;
    const double step = world.scene().time.step;
    const Bounds bounds = region_.bounds(world);
    const Vector3 periods = periods_of(world);
    entered_.resize(world.grains().size(), kOutside);
    for (std::size_t i = 0; i < entered_.size(); ++i) {
      const Grain& grain = world.grains()[i];
      if (grain.is_present()) {
        const Vector3 now = place_of(grain, world);
        const Vector3 before = now - step * velocity_of_move(grain.body);
        follow_way(i, world, stays_of_images(bounds, before, now, periods), bounds.contains(now), sample.time - step);
      } else if (is_inside(i)) {
        leave(i, world, sample.time - step);
      }
    }
  }

  void measure(const Sample& sample, TableText& table) const override {
    per_visit_ ? write_visits(sample, table) : write_kinds(sample, table);
  }
  void forget(const Sample& /*written*/) override { ended_.clear(); }
  bool has_unwritten() const override { return !ended_.empty(); }
  double bytes_of_event() const override { return per_visit_ ? kLineOfVisit : 0; }

  std::string save() const override { return to_bytes(entered_, kinds_, ended_); }
  void restore(const std::string& memory) override { Reader{memory}(entered_, kinds_, ended_); }

 private:
  VisitsOfKind& of_kind(const Grain& grain, const World& world) { return kinds_[world.scene().kind_of(*grain.kind)]; }

  bool is_inside(std::size_t index) const { return entered_[index] != kOutside; }

  /// Follows a step from `start` (s), of which the grain is inside in `stays`. Its states before and after hold within rounding.
  void follow_way(std::size_t index, const World& world, const std::vector<Stay>& stays, bool ends_inside, double start) {
    const double step = world.scene().time.step;
    double end = 0;  // of the last stay
    for (const Stay& stay : stays) {
      if (is_inside(index) && stay.from > end + kRounding) leave(index, world, start + step * end);
      if (!is_inside(index)) enter(index, world, start + step * stay.from);
      end = stay.to;
    }
    if (is_inside(index) && !ends_inside) leave(index, world, start + step * end);
    if (!is_inside(index) && ends_inside) enter(index, world, start + step);
  }

  void enter(std::size_t index, const World& world, double time) {
    entered_[index] = time;
    VisitsOfKind& kind = of_kind(world.grains()[index], world);
    ++kind.inside;
    ++kind.entered;
  }

  void leave(std::size_t index, const World& world, double time) {
    VisitsOfKind& kind = of_kind(world.grains()[index], world);
    --kind.inside;
    ++kind.left;
    if (entered_[index] != kUnknown) {
      kind.end(time - entered_[index]);
      if (per_visit_) ended_.push_back({index, entered_[index], time});
    }
    entered_[index] = kOutside;
  }

  void write_kinds(const Sample& sample, TableText& table) const {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      const VisitsOfKind& kind = kinds_[i];
      table.add(sample.time).add(sample.world.scene().kinds[i].kind.name).add(kind.inside).add(kind.entered).add(kind.left);
      table.add(kind.timed);
      kind.timed > 0 ? table.add(kind.mean) : table.blank();
      kind.timed > 1 ? table.add(std::sqrt(kind.squares / static_cast<double>(kind.timed - 1))) : table.blank();
      table.end_line();
    }
  }

  void write_visits(const Sample& sample, TableText& table) const {
    for (const Visit& visit : ended_) {
      const Grain& grain = sample.world.grains()[visit.grain];
      table.add(visit.grain).add(grain.kind->name).add(grain.scale).add(grain.scale * grain.kind->sieve_size());
      table.add(visit.entered).add(visit.left).add(visit.left - visit.entered).end_line();
    }
  }

  SamplingRegion region_;
  bool per_visit_;
  std::vector<double> entered_;      // s, of each grain
  std::vector<VisitsOfKind> kinds_;  // of the scene
  std::vector<Visit> ended_;         // since the last sample
};

}  // namespace

MeasurementKind residence_kind() {
  return {
      .name = "residence",
      .measures = "the time that grains spend in a box, from when their centres enter it until they leave it",
      .parameters = {{"lower, upper", "m, corners of the box"},
                     {"per", "sample or visit, for visits that have ended; sample without it"}},
      .columns =
          "per sample a line for each kind: time, kind, grains inside, entered and left since `from`, those that left after a "
          "known time of entry, mean and standard deviation of their residence; per visit: index, kind, scale and sieve size of "
          "the grain, times of entry and exit, residence",
      .source = "crossings are interpolated within a step",
      .follows = true,
      .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
        const SamplingRegion region(table, scene, SamplingRegion::Without::Refused);
        const bool is_per_visit = table.has("per") && table.choice("per", {"sample", "visit"}) == "visit";
        return [=](const World& world) { return std::make_unique<Residence>(world, region, is_per_visit); };
      }};
}

}  // namespace falling_particles
