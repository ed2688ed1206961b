// Materials of parts: a part with coefficients of its own is a material of its own.
#pragma once

#include <supernormal/effects.hpp>
#include <vector>

#include "wall.hpp"

namespace falling_particles {

/// The largest number of parts with coefficients of their own.
inline constexpr int kMostWallMaterials = 60;

/// The wall material, or that of the part alone where it has coefficients of its own.
supernormal::effects::Material material_of_wall(const std::vector<Wall>& walls, std::size_t index);

/// Adds the effects of parts with coefficients of their own. What a scene says of walls, and such a part does not, holds for it
/// too.
void add_wall_effects(const std::vector<Wall>& walls, std::vector<supernormal::effects::Effect>& effects);

}  // namespace falling_particles
