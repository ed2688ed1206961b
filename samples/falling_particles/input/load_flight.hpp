// Reads the [part.free] of a wall.
#pragma once

#include <optional>

#include "base/toml_input.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads `free` of a part, if it has one. The part's shape, pose, motions and drive must have been read. Throws InputError.
std::optional<Flight> read_flight(const TomlTable& part, const Wall& wall, const Time& time);

}  // namespace falling_particles
