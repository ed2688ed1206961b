#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "common/interval.hpp"
#include "doubts.hpp"
#include "forecast.hpp"
#include "model/container.hpp"
#include "model/material.hpp"

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

std::string from_until(double from, double until) {
  std::string text = from > 0 ? " from " + shortest(from) + " s" : "";
  if (std::isfinite(until)) text += " until " + shortest(until) + " s";
  return text;
}

std::string describe(const Feeder& feeder) {
  return feeder.name + ": " + feeder.rate.in_words() + "/s" + (feeder.total ? ", " + feeder.total->in_words() + " in all" : "") +
         from_until(feeder.from, feeder.until);
}

std::string describe(const BondRule& rule, std::uint64_t count, const Scene& scene) {
  std::string text =
      rule.name + ": " + counted(count, rule.kind == BondKind::Beam ? "beam" : "ball") + " of " + rounded(rule.modulus) + " Pa";
  if (rule.wall) text += ", to part \"" + scene.walls[*rule.wall].name + '"';
  return text;
}

std::string shape_of(const Wall& wall) {
  constexpr std::array kNames = {"plane", "box", "cylinder", "smooth body", "mesh", "ground"};
  return kNames[wall.shape.index()];
}

std::string describe(const Drive& drive) {
  const std::string unit = drive.turns() ? " N m" : " N";
  if (drive.servo) return "a servo to " + shortest(drive.servo->stress) + " Pa";
  if (drive.power > 0) return "driven by " + shortest(drive.power) + " W, up to " + shortest(drive.force) + unit;
  return "driven by " + shortest(drive.force) + unit;
}

std::string describe(const Wall& wall) {
  constexpr std::array kMotions = {"moves", "turns", "vibrates", "has a surface that moves"};
  std::string text = wall.name + ": " + shape_of(wall);
  for (const WallMotion& motion : wall.motions)
    text += std::string(", ") + kMotions[motion.kind.index()] + from_until(motion.from, motion.until);
  if (wall.flight) text += ", free, " + rounded(wall.flight->mass) + " kg" + from_until(wall.flight->from, INFINITY);
  if (wall.drive) text += ", " + describe(*wall.drive) + from_until(wall.drive->from, wall.drive->until);
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
  if (const std::optional<double> longest = step_for_look_ahead(scene)) {
    lines.add("steps", "up to " + rounded(*longest) + " s each leave overlaps of about 1e-3 of a half-axis in a bed at rest");
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
  if (scene.query) {
    lines.add("query", name_of(scene.query->solver) + ", tolerance " + shortest(scene.query->tolerance) + ", up to " +
                           std::to_string(scene.query->max_evaluations) + " evaluations, warm start " +
                           (scene.query->warm_start ? "on" : "off"));
  }
  for (const Feeder& feeder : scene.feeders) lines.add("feeders", describe(feeder));
  for (const Sink& sink : scene.sinks) lines.add("sinks", sink.name);
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    lines.add("bonds", describe(scene.bonds[i], forecast.bonds[i], scene));
  }
  for (const Wall& wall : scene.parts()) lines.add("parts", describe(wall));
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
  const auto of_all = [&](double a_grain) { return rounded(kMilli * a_grain * forecast.most_grains) + " ms"; };
  lines.add("time", "about " + in_time(forecast.seconds()) + " of processor time, if all grains lay in a bed from the start");
  lines.add("time", rounded(kMilli * forecast.bed_step()) + " ms a step then, of which the solver " + of_all(forecast.bed.solver) +
                        ", contacts " + of_all(forecast.bed.narrow_phase) + "; at the start " +
                        rounded(kMilli * forecast.start_step) + " ms a step");
  for (const std::string& doubt : doubts_about(scene)) lines.add("warning", doubt);
  return lines.text();
}

}  // namespace falling_particles
