// The keys of a scene file, as text for users. Effects and measurements list their own.
#pragma once

#include <string>

namespace falling_particles {

/// The sections besides parts, feeders and sinks. Below each section, or each kind of it, every key has a line with its unit, range
/// and default. A test compares the keys with those that the loader accepts.
std::string list_sections();

/// The shapes, motions and drives of [[part]] with their parameters, units and ranges.
std::string list_walls();

/// The parameters of [[feeder]] and [[sink]] with units and ranges.
std::string list_population();

}  // namespace falling_particles
