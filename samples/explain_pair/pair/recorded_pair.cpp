#include "pair/recorded_pair.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <string_view>
#include <supernormal/proximity/solve.hpp>
#include <vector>

#include "base/input_error.hpp"
#include "base/interval.hpp"
#include "base/read_file.hpp"
#include "model/grain_shape.hpp"
#include "model/scene.hpp"
#include "pair/described_body.hpp"
#include "world/placement.hpp"

namespace explain_pair {
namespace {

using falling_particles::GrainKind;
using falling_particles::InputError;
using falling_particles::Scene;
using falling_particles::shortest;

constexpr std::size_t kColumns = 10;
constexpr std::string_view kHead = "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz";

// A time selects the frame that agrees to this, so that it need not be typed with all digits.
constexpr double kSameTime = 1e-6;  // s

struct RecordedBody {
  std::string grain;
  Pose pose;
};

template <typename Number = double>
Number number_of(std::string_view text, const std::string& path, unsigned line) {
  Number value = 0;
  const auto [end, error] = std::from_chars(text.begin(), text.end(), value);
  if (error != std::errc() || end != text.end()) throw InputError(path, line, "\"" + std::string(text) + "\" is not a number");
  return value;
}

std::array<std::string_view, kColumns> columns_of(std::string_view row, const std::string& path, unsigned line) {
  std::array<std::string_view, kColumns> columns;
  for (std::size_t k = 0; k < kColumns; ++k) {
    const std::size_t comma = row.find(',');
    const bool is_last = k + 1 == kColumns;
    if (is_last != (comma == std::string_view::npos))
      throw InputError(path, line, "the line has not the " + std::to_string(kColumns) + " columns " + std::string(kHead));
    columns[k] = row.substr(0, comma);
    row.remove_prefix(is_last ? row.size() : comma + 1);
  }
  return columns;
}

/// The frame nearest to a time: its time and its bodies by index. Removed bodies are missing.
struct NearestFrame {
  double time = std::numeric_limits<double>::infinity();
  std::map<std::size_t, RecordedBody> bodies = {};
};

NearestFrame nearest_frame(const std::string& path, double wanted) {
  if (const std::string other = falling_particles::what_is_no_file(path); !other.empty()) {
    throw InputError("--trajectory: \"" + path + "\" is " + other + "; allowed: a file");
  }
  std::ifstream stream(path);
  std::string row;
  if (!std::getline(stream, row)) throw InputError("cannot read \"" + path + "\"; allowed: the trajectory.csv of a run");
  if (row != kHead)
    throw InputError(path, 1, "the line is not \"" + std::string(kHead) + "\"; allowed: the trajectory.csv of a run");
  NearestFrame nearest;
  for (unsigned line = 2; std::getline(stream, row); ++line) {
    const auto columns = columns_of(row, path, line);
    const double time = number_of(columns[0], path, line);
    if (std::abs(time - wanted) > std::abs(nearest.time - wanted)) continue;
    if (time != nearest.time) nearest = {time};
    std::array<double, 7> numbers;
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = number_of(columns[3 + k], path, line);
    const auto place = path + ":" + std::to_string(line) + ": the quaternion";
    const std::array quaternion = {numbers[3], numbers[4], numbers[5], numbers[6]};
    nearest.bodies[number_of<std::size_t>(columns[1], path, line)] = {
        std::string(columns[2]), {{numbers[0], numbers[1], numbers[2]}, rotation_of(place, quaternion)}};
  }
  if (nearest.bodies.empty()) throw InputError("\"" + path + "\" has no frames; allowed: the trajectory.csv of a run");
  if (!(std::abs(nearest.time - wanted) <= kSameTime)) {
    throw InputError("--time is " + shortest(wanted) + "; allowed: the time of a frame of \"" + path + "\", of which " +
                     shortest(nearest.time) + " s is the nearest");
  }
  return nearest;
}

/// The bodies of a frame with their shapes.
class Grains {
 public:
  Grains(const Recording& recording)
      : recording_(recording),
        scene_(falling_particles::load_scene(recording.scene_path, recording.overrides)),
        bodies_(nearest_frame(recording.trajectory_path, recording.time).bodies) {
    if (!scene_.has_sizes()) return;
    falling_particles::Random random(scene_.seed);  // in the order in which the run drew them
    const auto placements = place(scene_, random);
    scales_.reserve(placements.size());
    for (const auto& placement : placements) scales_.push_back(placement.scale);
  }

  const Scene& scene() const { return scene_; }

  void require_index(std::size_t index) const {
    if (bodies_.contains(index)) return;
    const std::size_t low = bodies_.begin()->first, high = bodies_.rbegin()->first;
    const bool is_whole = high - low + 1 == bodies_.size();
    throw InputError("--bodies: there is no body " + std::to_string(index) + "; allowed: " + std::to_string(low) + " to " +
                     std::to_string(high) + (is_whole ? "" : ", without those that have gone"));
  }

  PlacedBody body(std::size_t index) const {
    const GrainKind& kind = entry_of(index).kind;
    std::string text = "body " + std::to_string(index) + ": " + kind.name;
    if (!kind.components.empty()) {
      throw InputError("--bodies: " + text + " is a compound; allowed: grains of one convex body");
    }
    return {text, falling_particles::shape_of(kind.all_components().front().body, scale_of(index)), bodies_.at(index).pose};
  }

  /// The body with the smallest gap to the body `first`.
  std::size_t nearest_to(std::size_t first) const {
    const PlacedBody body1 = body(first);
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = first;
    for (const auto& [index, other] : bodies_) {
      const double between = (other.pose.position - body1.pose.position).norm();
      // The bounding spheres of the two bodies bound their gap from below.
      if (index == first || between - radius_of(first) - radius_of(index) > least) continue;
      const PlacedBody body2 = body(index);
      const double gap = supernormal::find_proximity(*body1.shape, body1.pose, *body2.shape, body2.pose).gap;
      if (gap < least) {
        least = gap;
        nearest = index;
      }
    }
    if (nearest == first) throw InputError("--bodies: there is no other body; allowed: bodies of a run of two or more");
    return nearest;
  }

 private:
  double scale_of(std::size_t index) const {
    if (index < scales_.size()) return scales_[index];
    const auto& entry = entry_of(index);
    if (entry.size) {
      throw InputError(
          "--bodies: body " + std::to_string(index) + ": " + entry.kind.name +
          " came from a feeder, and a trajectory does not tell its size; allowed: runs in which such kinds are not fed");
    }
    return 1;
  }
  double radius_of(std::size_t index) const { return scale_of(index) * entry_of(index).kind.bounding_radius(); }

  const falling_particles::GrainCount& entry_of(std::size_t index) const {
    const std::string& name = bodies_.at(index).grain;
    const auto entry = std::ranges::find_if(scene_.kinds, [&](const auto& one) { return one.kind.name == name; });
    if (entry == scene_.kinds.end()) {
      throw InputError("\"" + recording_.trajectory_path + "\" has a grain \"" + name + "\", which \"" + recording_.scene_path +
                       "\" has not; allowed: the trajectory of a run of this scene");
    }
    return *entry;
  }

  const Recording& recording_;
  Scene scene_;
  std::map<std::size_t, RecordedBody> bodies_;
  std::vector<double> scales_;  // scale factors of the grains; empty if all are 1
};

}  // namespace

Pair recorded_pair(const Recording& recording) {
  const Grains grains(recording);
  grains.require_index(recording.first);
  if (recording.second) grains.require_index(*recording.second);
  if (recording.second == recording.first) {
    throw InputError("--bodies: both are " + std::to_string(recording.first) + "; allowed: two different bodies");
  }
  const std::size_t second = recording.second ? *recording.second : grains.nearest_to(recording.first);
  return {.title = grains.scene().name + " at " + shortest(recording.time) + " s",
          .body1 = grains.body(recording.first),
          .body2 = grains.body(second)};
}

}  // namespace explain_pair
