// Motions, drives and flights of walls in scene files.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/toml_input.hpp"
#include "common/motion.hpp"
#include "model/scene.hpp"

namespace falling_particles {

Vector3 read_vector(const TomlTable& table, const char* key, const Interval& allowed);

/// Reads a direction of any length but 0, and returns its unit vector.
Vector3 read_direction(const TomlTable& table, const char* key);

/// Reads `corner` and `size` (m).
Region read_region(const TomlTable& table);

/// The most revolutions of a wall in a step. The mean velocity of a step assumes the smaller rotation.
inline constexpr double kLargestTurn = 0.1;

/// Reads `rpm`, revolutions per minute, up to kLargestTurn in a step.
double read_rpm(const TomlTable& table, const Time& time);

/// Reads `frequency` (Hz) of a vibration, whose period takes at least ten steps.
double read_frequency(const TomlTable& table, const Time& time);

/// Reads `phase` in degrees and returns it in radians; 0 if it is not given.
double read_phase(const TomlTable& table);

/// Reads `from` and `until` (s); 0 and infinity if they are not given.
std::pair<double, double> read_times(const TomlTable& table);

/// Reads the motions of a wall. Throws InputError.
std::vector<WallMotion> read_motions(const TomlTable& part, const Time& time);

/// Reads `free` of a part, if it has one. The part's shape, pose, motions and drive must have been read. Throws InputError.
std::optional<Flight> read_flight(const TomlTable& part, const Wall& wall, const Time& time);

/// Reads `drive` of a part, if it has one. The part's shape, pose and motions must have been read. A plane pushes along its normal
/// unless the drive has an axis. A servo without an area is between the walls of `between`, or those that load_servos() reads if
/// there are none. Throws InputError.
std::optional<Drive> read_drive(const TomlTable& part, const Wall& wall, const std::vector<FacingWalls>& between);

/// Reads the walls between which servos are. All walls of the scene must have been read. Throws InputError.
void load_servos(const TomlTable& root, Scene& scene);

}  // namespace falling_particles
