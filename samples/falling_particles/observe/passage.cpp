// The measurement passage: the grains that pass a plane.

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/archive.hpp"
#include "measurement.hpp"
#include "region.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

struct PassedAmount {
  std::size_t grains = 0;
  double mass = 0;  // kg

  void serialize(auto& archive) { archive(grains, mass); }
};

/// The grains of a kind that have passed along the axis and against it.
struct PassedOfKind {
  PassedAmount forward, backward;
  PassedAmount forward_before, backward_before;  // at the last sample

  void serialize(auto& archive) { archive(forward, backward, forward_before, backward_before); }
};

struct PassedGrain {
  double time = 0;  // s
  std::size_t grain = 0;
  bool is_forward = false;  // along the axis
  Point position = {};      // m
  Point velocity = {};      // m/s

  void serialize(auto& archive) { archive(time, grain, is_forward, position, velocity); }
};

constexpr double kLineOfPassage = 170;  // bytes, in feeder.toml

struct PassedPlane : AxisPlane {
  std::optional<SamplingRegion> window;  // without one the plane has no end

  bool has_in_window(const Vector3& place, const World& world) const {
    if (!window) return true;
    const Bounds bounds = window->bounds(world);
    for (std::size_t other = 0; other < 3; ++other) {
      const auto i = static_cast<Eigen::Index>(other);
      if (other != axis && (place[i] < bounds.lower[i] || place[i] >= bounds.upper[i])) return false;
    }
    return true;
  }
};

class Passage final : public Measurement {
 public:
  Passage(const World& world, const PassedPlane& plane, bool per_grain)
      : plane_(plane), per_grain_(per_grain), kinds_(world.scene().kinds.size()) {}

  std::string columns() const override {
    return per_grain_ ? "time_s,body,grain,scale,sieve_size_m,mass_kg,direction,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s"
                      : "time_s,grain,forward,forward_kg,backward,backward_kg,grains_per_s,kg_per_s";
  }

  void begin(const Sample& sample) override {
    sampled_at_ = sample.time;
    for (const Grain& grain : sample.world.present()) remember(grain, sample.world);
  }

  void follow(const Sample& sample) override {
    for (const Grain& grain : sample.world.present()) {
      if (const auto passed = find_passage(grain, sample)) count(grain, *passed, sample.world);
      remember(grain, sample.world);
    }
  }

  void measure(const Sample& sample, TableText& table) const override {
    per_grain_ ? write_grains(sample, table) : write_kinds(sample, table);
  }

  void forget(const Sample& written) override {
    passed_.clear();
    for (PassedOfKind& kind : kinds_) {
      kind.forward_before = kind.forward;
      kind.backward_before = kind.backward;
    }
    sampled_at_ = written.time;
  }

  bool has_unwritten() const override { return !passed_.empty(); }
  double bytes_of_event() const override { return per_grain_ ? kLineOfPassage : 0; }

  std::string save() const override { return to_bytes(kinds_, passed_, sampled_at_, places_); }
  void restore(const std::string& memory) override { Reader{memory}(kinds_, passed_, sampled_at_, places_); }

 private:
  void remember(const Grain& grain, const World& world) {
    const std::size_t index = world.index_of(grain);
    if (index >= places_.size()) places_.resize(index + 1);
    places_[index] = to_point(place_of(grain, world));
  }

  /// Whether the grain passed in the last step. Its side before is that of the place after the step before, to the bit: rounding
  /// neither loses nor repeats a passage. In a periodic cell the nearest image of the plane counts.
  std::optional<PassedGrain> find_passage(const Grain& grain, const Sample& sample) const {
    const World& world = sample.world;
    const auto axis = static_cast<Eigen::Index>(plane_.axis);
    const Vector3 periods = periods_of(world);
    const auto nearest = [&](double distance, Eigen::Index along) {
      return periods[along] > 0 ? distance - periods[along] * std::round(distance / periods[along]) : distance;
    };
    const Vector3 now = place_of(grain, world);
    const std::size_t index = world.index_of(grain);
    const bool is_new = index >= places_.size() || !places_[index];
    const Vector3 old = is_new ? place_before(grain, world) : to_vector(places_[index]->data());
    const double before = nearest(old[axis] - plane_.at, axis);
    const double after = nearest(now[axis] - plane_.at, axis);
    if ((before < 0) == (after < 0)) return std::nullopt;
    const double way = after - before;
    if (periods[axis] > 0 && std::abs(way) > periods[axis] / 2) return std::nullopt;  // from image to image, far from the plane
    const double part = after / way;                                                  // of the step, since the passage
    Vector3 place = now;
    for (Eigen::Index i = 0; i < 3; ++i) place[i] -= part * nearest(now[i] - old[i], i);
    place = image_in_cell(place, world);
    if (!plane_.has_in_window(place, world)) return std::nullopt;
    return PassedGrain{sample.time - part * world.scene().time.step, index, way > 0, to_point(place), grain.velocity()};
  }

  void count(const Grain& grain, const PassedGrain& passed, const World& world) {
    PassedOfKind& kind = kinds_[world.scene().kind_of(*grain.kind)];
    PassedAmount& amount = passed.is_forward ? kind.forward : kind.backward;
    ++amount.grains;
    amount.mass += grain.mass.mass;
    if (per_grain_) passed_.push_back(passed);
  }

  void write_kinds(const Sample& sample, TableText& table) const {
    const double time = sample.time - sampled_at_;
    const auto number = [](const PassedAmount& amount) { return static_cast<double>(amount.grains); };
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      const auto& [forward, backward, forward_before, backward_before] = kinds_[i];
      table.add(sample.time).add(sample.world.scene().kinds[i].kind.name);
      table.add(forward.grains).add(forward.mass).add(backward.grains).add(backward.mass);
      if (time > 0) {
        table.add((number(forward) - number(forward_before) - number(backward) + number(backward_before)) / time);
        table.add((forward.mass - forward_before.mass - backward.mass + backward_before.mass) / time).end_line();
      } else {
        table.blank(2).end_line();
      }
    }
  }

  void write_grains(const Sample& sample, TableText& table) const {
    for (const PassedGrain& passed : passed_) {
      const Grain& grain = sample.world.grains()[passed.grain];
      table.add(passed.time).add(passed.grain).add(grain.kind->name).add(grain.scale).add(grain.scale * grain.kind->sieve_size());
      table.add(grain.mass.mass).add(passed.is_forward ? 1.0 : -1.0).add(passed.position).add(passed.velocity).end_line();
    }
  }

  PassedPlane plane_;
  bool per_grain_;
  std::vector<PassedOfKind> kinds_;           // of the scene
  std::vector<PassedGrain> passed_;           // since the last sample
  double sampled_at_ = 0;                     // s
  std::vector<std::optional<Point>> places_;  // m, of each grain after the last step
};

}  // namespace

MeasurementKind passage_kind() {
  constexpr double kFarthest = 1e6;  // m
  return {
      .name = "passage",
      .measures = "the grains whose centres pass a plane, and their rates",
      .parameters = {{"axis", "x, y or z, at right angles to the plane"},
                     {"at", "m, of the plane along the axis"},
                     {"lower, upper",
                      "m, corners of a box to which the plane is limited across the axis; without them it has no end"},
                     {"per", "sample or grain, for grains that pass; sample without it"}},
      .columns =
          "per sample a line for each kind: time, kind, numbers and masses that have passed along the axis and against it since "
          "`from`, net rates since the last sample; per grain: time, index, kind, scale, sieve size, mass, direction (1 along the "
          "axis, -1 against it), position, velocity",
      .source = "crossings are interpolated within a step",
      .follows = true,
      .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
        PassedPlane plane{{read_axis(table, "axis"), table.number("at", Interval::closed(-kFarthest, kFarthest, "m"))}, {}};
        if (table.has("lower") || table.has("upper")) plane.window.emplace(table, scene, SamplingRegion::Without::Refused);
        const bool is_per_grain = table.has("per") && table.choice("per", {"sample", "grain"}) == "grain";
        return [=](const World& world) { return std::make_unique<Passage>(world, plane, is_per_grain); };
      }};
}

}  // namespace falling_particles
