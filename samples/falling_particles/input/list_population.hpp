// The list of the keys of feeders and sinks.
#pragma once

#include <string>

namespace falling_particles {

/// The parameters of [[feeder]] and [[sink]] with units and ranges, for users.
std::string list_population();

}  // namespace falling_particles
