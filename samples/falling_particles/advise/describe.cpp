#include <cmath>
#include <optional>
#include <string_view>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "forecast.hpp"
#include "model/container.hpp"
#include "model/wall.hpp"

namespace falling_particles {
namespace {

class Lines {
 public:
  /// Adds a line. Of successive lines with the same name, only the first shows it.
  void add(const std::string& name, const std::string& text) {
    constexpr std::size_t kWidth = 14;
    std::string start = name == last_ ? "" : name;
    last_ = name;
    start.resize(kWidth, ' ');
    text_ += start + text + '\n';
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_, last_;
};

std::string in_bytes(double bytes) {
  constexpr double kThousand = 1000;
  for (const char* unit : {" bytes", " kB", " MB"}) {
    if (bytes < kThousand) return (bytes < 10 ? rounded(bytes) : std::to_string(std::lround(bytes))) + unit;
    bytes /= kThousand;
  }
  return rounded(bytes) + " GB";
}

std::string in_time(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 60 * kMinute;
  if (seconds < 2 * kMinute) return rounded(seconds) + " s";
  if (seconds < 2 * kHour) return rounded(seconds / kMinute) + " minutes";
  return rounded(seconds / kHour) + " hours";
}

std::string kinds_of(const Scene& scene) {
  std::string text;
  for (const GrainCount& entry : scene.kinds) {
    text += (text.empty() ? "" : ", ") + (entry.count > 0 ? std::to_string(entry.count) + ' ' : "") + entry.kind.name +
            (entry.size ? " of many sizes" : "");
  }
  return text;
}

std::string describe(const StartState& start) {
  std::string text = "from " + start.file.filename().string();
  if (start.time) text += ", " + shortest(*start.time) + " s after the start of its run";
  return text + (start.has_velocities ? "; the fastest grain has " + rounded(start.largest_speed()) + " m/s"
                                      : "; it has no velocities: all grains start at rest");
}

/// The walls to which an effect of grains is limited, in words.
std::string where(const supernormal::effects::Effect& effect, const std::vector<Wall>& walls) {
  const auto on = std::visit(
      [](const auto& one) -> std::optional<supernormal::effects::MaterialSelector> {
        if constexpr (requires { one.on; }) return one.on;
        return std::nullopt;
      },
      effect);
  if (on == kGrainOnWall) return " on walls";
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (on && on == supernormal::effects::MaterialSelector::between(kGrainMaterial, material_of_wall(walls, i))) {
      return " on " + walls[i].called();
    }
  }
  return "";
}

void add_scene(Lines& lines, const Scene& scene, const Forecast& forecast) {
  std::string place = kind_of(scene.container);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (scene.periodic[axis]) place += std::string(", repeats along ") + "xyz"[axis];
  }
  lines.add("scene", scene.name + ", in a " + place);
  lines.add("steps", std::to_string(forecast.steps) + " of " + shortest(scene.time.step) + " s, " +
                         counted(static_cast<std::size_t>(forecast.frames), "frame"));
  if (const auto& accuracy = scene.solver.stepper) {
    std::string solver = "stepper: " + std::to_string(accuracy->least) + " to " + std::to_string(accuracy->most) +
                         " sub-steps a step; at rest contacts overlap by up to " + shortest(accuracy->sag) +
                         " of the least radius of gyration";
    if (const double longest = longest_step(scene, true); std::isfinite(longest)) {
      solver += "; time.step up to " + rounded(longest) + " s would do, with quickstep up to " +
                rounded(longest_step(scene, false)) + " s";
    }
    lines.add("solver", solver);
  }
  std::string grains = std::to_string(scene.grains_at_start()) + " at the start: " + kinds_of(scene);
  if (!scene.feeders.empty()) grains += "; up to " + std::to_string(forecast.most_grains) + " with those of the feeders";
  lines.add("grains", grains);
  if (scene.start) lines.add("start", describe(*scene.start));
  if (const std::optional<Fall> fall = fall_from_start(scene)) {
    lines.add("start", "grains fall up to " + rounded(fall->height) + " m, without drag with up to " + rounded(fall->speed) +
                           " m/s, " + rounded(fall->way) + " m a step, " + rounded(fall->way / scene.smallest_half_axis()) +
                           " of the smallest half-axis");
  }
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    lines.add("bonds", scene.bonds[i].name + ": " + counted(forecast.bonds[i], "bond"));
  }
  for (const supernormal::effects::Effect& effect : scene.effects) {
    const supernormal::effects::Description& description = supernormal::effects::descriptions()[effect.index()];
    lines.add("effects", std::string(description.name) + where(effect, scene.walls) + ": " +
                             counted(static_cast<std::size_t>(description.rows), "row") + " a contact; " + description.passes);
  }
  for (std::size_t i = 0; i < scene.measurements.size(); ++i) {
    lines.add("measurements",
              scene.measurements[i].name + ": " + scene.measurements[i].kind + ", " + counted(forecast.samples[i], "sample"));
  }
  for (const std::string& format : scene.pictures) lines.add("pictures", format);
}

}  // namespace

std::string describe(const Scene& scene, const Forecast& forecast) {
  Lines lines;
  add_scene(lines, scene, forecast);
  lines.add("memory", in_bytes(forecast.memory) + " at most, in a bed of all grains");
  lines.add("disk", in_bytes(forecast.table_bytes) + " of tables, " + in_bytes(forecast.picture_bytes) + " of pictures");
  constexpr double kMilli = 1e3;
  lines.add("time", "about " + in_time(forecast.seconds()) + " of processor time, if all steps took " +
                        rounded(kMilli * forecast.step) + " ms as the first " + std::to_string(forecast.timed_steps));
  for (const std::string& doubt : doubts_about(scene)) lines.add("warning", doubt);
  return lines.text();
}

}  // namespace falling_particles
