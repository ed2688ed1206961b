// Reads the [[part.motion]] sections of a part.
#pragma once

#include <utility>
#include <vector>

#include "parts/motion.hpp"
#include "scene/scene.hpp"
#include "scene/toml_input.hpp"

namespace falling_particles {

Vector3 read_vector(const TomlTable& table, const char* key, const Interval& allowed);

/// A direction of any length but 0, as a unit vector.
Vector3 read_direction(const TomlTable& table, const char* key);

/// `from` and `until` (s): 0 and never if they are not given.
std::pair<double, double> read_times(const TomlTable& table);

/// The motions of a part. Throws InputError.
std::vector<PartMotion> read_motions(const TomlTable& part, const Time& time);

}  // namespace falling_particles
