// The list of the keys of all other sections of a scene: no effects, measurements, parts, feeders and sinks.
#pragma once

#include <string>

namespace falling_particles {

/// The list for users, as text. Under the name of each section, or of each kind of it, there is a line for every key with its unit,
/// range and default. A test compares it with the keys that the loader accepts.
std::string list_sections();

}  // namespace falling_particles
