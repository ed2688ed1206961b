// What a scene may say besides its effects, measurements, parts, feeders and sinks.
#pragma once

#include <string>

namespace falling_particles {

/// The list for users, as text: under the name of each section, or of each kind of it, a line for every key with its unit, range
/// and default. A test holds it against what the loader takes.
std::string list_sections();

}  // namespace falling_particles
