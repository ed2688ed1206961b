// Reads the [[part.motion]] sections of a part.
#pragma once

#include <utility>
#include <vector>

#include "base/toml_input.hpp"
#include "model/motion.hpp"
#include "model/scene.hpp"

namespace falling_particles {

Vector3 read_vector(const TomlTable& table, const char* key, const Interval& allowed);

/// A direction of any length but 0, as a unit vector.
Vector3 read_direction(const TomlTable& table, const char* key);

/// Revolutions of a part in a step, at most: the velocity of a step is that of the smaller turn.
inline constexpr double kLargestTurn = 0.1;

/// `rpm`: revolutions a minute, up to kLargestTurn in a step.
double read_rpm(const TomlTable& table, const Time& time);

/// `frequency` (Hz) of a vibration, a period of which takes at least ten steps.
double read_frequency(const TomlTable& table, const Time& time);

/// `phase`, in degrees there, in radians here; 0 if it is not given.
double read_phase(const TomlTable& table);

/// `from` and `until` (s): 0 and never if they are not given.
std::pair<double, double> read_times(const TomlTable& table);

/// The motions of a part. Throws InputError.
std::vector<WallMotion> read_motions(const TomlTable& part, const Time& time);

}  // namespace falling_particles
