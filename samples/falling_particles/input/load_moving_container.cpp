#include "load_moving_container.hpp"

#include <numbers>

#include "load_container.hpp"
#include "load_motion.hpp"

namespace falling_particles {
namespace {

double read_length(const TomlTable& table, const char* key) { return table.number(key, Interval::positive(kLargestLength, "m")); }

/// Reads the start (s) of a motion; 0 if it is not given.
double read_start(const TomlTable& table, const char* key, const Time& time) {
  return table.has(key) ? table.number(key, {0, time.duration, true, false, "s (before time.duration)"}) : 0;
}

}  // namespace

Drum read_drum(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "diameter", "length", "segments", "rpm", "smooth", "turns_at"});
  Drum drum{};
  drum.diameter = read_length(table, "diameter");
  drum.length = read_length(table, "length");
  drum.segments = static_cast<int>(table.integer("segments", 8, 10'000));
  drum.rpm = read_rpm(table, time);
  drum.is_smooth = table.has("smooth") && table.boolean("smooth");
  drum.turns_at = read_start(table, "turns_at", time);
  return drum;
}

Tray read_tray(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys(
      {"kind", "width", "wall_height", "thickness", "direction", "amplitude", "frequency", "phase", "shakes_at"});
  Tray tray{};
  tray.width = read_width(table);
  tray.wall_height = read_length(table, "wall_height");
  tray.thickness = read_length(table, "thickness");
  const Vector3 direction = read_direction(table, "direction");
  tray.direction = {direction.x(), direction.y(), direction.z()};
  tray.amplitude = read_length(table, "amplitude");
  tray.frequency = read_frequency(table, time);
  tray.phase = read_phase(table);
  tray.shakes_at = read_start(table, "shakes_at", time);
  return tray;
}

ShearCell read_shear_cell(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys(
      {"kind", "width", "height", "cut", "thickness", "speed", "pressure", "lid_mass", "lid", "presses_at", "shears_at"});
  ShearCell cell{};
  cell.width = read_width(table);
  cell.height = read_length(table, "height");
  cell.cut = table.number("cut", {0, cell.height, false, false, "m (below container.height)"});
  cell.lid = table.number("lid", {cell.cut, cell.height, false, true, "m (from container.cut to container.height)"});
  cell.thickness = read_length(table, "thickness");
  cell.presses_at = read_start(table, "presses_at", time);
  cell.shears_at = read_start(table, "shears_at", time);
  const double most = cell.thickness / (time.duration - cell.shears_at);
  cell.speed =
      table.number("speed", Interval::closed(-most, most, "m/s (until time.duration the lower half moves by container.thickness)"));
  cell.pressure = table.number("pressure", Interval::closed(0, 1e9, "Pa"));
  cell.lid_mass = table.number("lid_mass", Interval::positive(1e6, "kg"));
  return cell;
}

ConveyorBelt read_conveyor_belt(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "length", "width", "height", "thickness", "wall_height", "speed", "drop_length", "starts_at"});
  ConveyorBelt belt{};
  belt.length = read_length(table, "length");
  belt.width = read_length(table, "width");
  belt.height = read_length(table, "height");
  belt.thickness = table.number("thickness", Interval::positive(belt.height, "m (up to container.height)"));
  belt.wall_height = read_length(table, "wall_height");
  belt.drop_length = table.number("drop_length", {belt.thickness / 2, kLargestLength, false, true, "m (beyond the last roller)"});
  const double most = kLargestTurn * std::numbers::pi * belt.thickness / time.step;
  belt.speed = table.number("speed", Interval::positive(most, "m/s (a roller rotates by a tenth of a revolution in time.step)"));
  belt.starts_at = read_start(table, "starts_at", time);
  return belt;
}

}  // namespace falling_particles
