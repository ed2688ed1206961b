#include "load_motion.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace falling_particles {
namespace {

Rotation read_rotation(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "axis", "point", "rpm", "from", "until"});
  return {read_direction(table, "axis"), read_vector(table, "point", Interval::closed(-kLargestLength, kLargestLength, "m")),
          read_rpm(table, time)};
}

Vibration read_vibration(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "direction", "amplitude", "frequency", "phase", "from", "until"});
  Vibration vibration{};
  vibration.amplitude = table.number("amplitude", Interval::positive(kLargestLength, "m")) * read_direction(table, "direction");
  vibration.frequency = read_frequency(table, time);
  vibration.phase = read_phase(table);
  return vibration;
}

Conveyor read_conveyor(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "velocity", "axis", "point", "rpm", "from", "until"});
  Conveyor conveyor{Vector3::Zero(), {Vector3::UnitZ(), Vector3::Zero(), 0}};
  const bool turns = table.has("axis") || table.has("point") || table.has("rpm");
  if (table.has("velocity") || !turns) {
    conveyor.velocity =
        read_vector(table, "velocity", Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s (or axis, point and rpm)"));
  }
  if (turns) {
    conveyor.turn = {read_direction(table, "axis"),
                     read_vector(table, "point", Interval::closed(-kLargestLength, kLargestLength, "m")), read_rpm(table, time)};
  }
  return conveyor;
}

decltype(WallMotion::kind) read_kind(const TomlTable& table, const Time& time) {
  const std::string kind = table.choice("kind", {"velocity", "rotation", "vibration", "conveyor"});
  if (kind == "rotation") return read_rotation(table, time);
  if (kind == "vibration") return read_vibration(table, time);
  if (kind == "conveyor") return read_conveyor(table, time);
  table.refuse_unknown_keys({"kind", "velocity", "from", "until"});
  return Translation{read_vector(table, "velocity", Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s"))};
}

WallMotion read_motion(const TomlTable& table, const Time& time) {
  const auto kind = read_kind(table, time);
  const auto [from, until] = read_times(table);
  return {kind, from, until};
}

}  // namespace

Vector3 read_vector(const TomlTable& table, const char* key, const Interval& allowed) {
  const std::vector<double> v = table.numbers(key, 3, allowed);
  return {v[0], v[1], v[2]};
}

Vector3 read_direction(const TomlTable& table, const char* key) {
  const Vector3 v = read_vector(table, key, Interval::closed(-1e6, 1e6, "(a direction, not 0)"));
  if (v.norm() > 1e-6) return v.normalized();
  table.fail(key, table.full_name(key) + " is [0, 0, 0]; allowed: a direction, not 0");
}

Region read_region(const TomlTable& table) {
  const Vector3 corner = read_vector(table, "corner", Interval::closed(-kLargestLength, kLargestLength, "m"));
  const Vector3 size = read_vector(table, "size", Interval::positive(kLargestLength, "m"));
  return {{corner.x(), corner.y(), corner.z()}, {size.x(), size.y(), size.z()}};
}

double read_rpm(const TomlTable& table, const Time& time) {
  const double most = 60 * kLargestTurn / time.step;
  return table.number("rpm", Interval::closed(-most, most, "revolutions a minute (a tenth of one in time.step)"));
}

double read_frequency(const TomlTable& table, const Time& time) {
  constexpr double kStepsPerPeriod = 10;
  return table.number("frequency",
                      Interval::positive(1 / (kStepsPerPeriod * time.step), "Hz (a period has at least ten time.step)"));
}

double read_phase(const TomlTable& table) {
  return table.has("phase") ? table.number("phase", Interval::closed(-360, 360, "degrees")) * std::numbers::pi / 180 : 0;
}

std::pair<double, double> read_times(const TomlTable& table) {
  constexpr double kLatest = 1e6;
  const double from = table.has("from") ? table.number("from", Interval::closed(0, kLatest, "s")) : 0;
  const double until = table.has("until") ? table.number("until", {from, kLatest, false, true, "s (after from)"})
                                          : std::numeric_limits<double>::infinity();
  return {from, until};
}

std::vector<WallMotion> read_motions(const TomlTable& part, const Time& time) {
  std::vector<WallMotion> motions;
  const std::vector<std::string> keys = {"kind",      "velocity",  "axis",  "point",     "rpm",  "from",
                                         "direction", "amplitude", "phase", "frequency", "until"};
  for (const TomlTable& table : part.tables("motion", keys)) motions.push_back(read_motion(table, time));
  return motions;
}

}  // namespace falling_particles
