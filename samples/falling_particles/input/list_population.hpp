// The feeders and sinks that a scene may name, as text.
#pragma once

#include <string>

namespace falling_particles {

/// [[feeder]] and [[sink]] with their parameters, units and ranges, for users.
std::string list_population();

}  // namespace falling_particles
