// Pairs of walls that face each other: the sides of a cell of grains.
#pragma once

#include <string>
#include <vector>

#include "base/toml_input.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// Reads `key`, an array of the names of 2 `count` walls, which face each other two by two. Throws InputError unless each two are
/// planes or boxes with parallel faces and a distance at the start, and all distances are at right angles to each other and to
/// `across` (unit or zero).
std::vector<FacingWalls> read_facing_walls(const TomlTable& table, const char* key, std::size_t count,
                                           const std::vector<Wall>& walls, const Vector3& across);

/// The faces of a pair at the start, in the order of the names. The walls must exist and have such faces.
FacingFaces faces_at_start(const FacingWalls& pair, const std::vector<Wall>& walls);

}  // namespace falling_particles
