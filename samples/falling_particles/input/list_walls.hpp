// The list of the keys of [[part]].
#pragma once

#include <string>

namespace falling_particles {

/// The shapes, motions and drives of [[part]] with their parameters, units and ranges, for users.
std::string list_walls();

}  // namespace falling_particles
