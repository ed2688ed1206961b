// The materials of grains and walls.
#pragma once

#include <supernormal/effects.hpp>
#include <vector>

#include "wall.hpp"

namespace falling_particles {

constexpr supernormal::effects::Material kGrainMaterial = 0;
constexpr supernormal::effects::Material kWallMaterial = 1;
constexpr auto kGrainOnWall = supernormal::effects::MaterialSelector::between(kGrainMaterial, kWallMaterial);

/// The largest number of walls with coefficients of their own.
inline constexpr int kMostWallMaterials = 60;

/// Pa; the contact modulus E* of two bodies of this material (Johnson, Contact Mechanics, 4.2).
inline double contact_modulus(const supernormal::effects::Hertz& hertz) {
  return hertz.youngs_modulus / (2 * (1 - hertz.poisson_ratio * hertz.poisson_ratio));
}

/// The common material of walls, or a material of its own for a wall with coefficients of its own.
supernormal::effects::Material material_of_wall(const std::vector<Wall>& walls, std::size_t index);

/// Adds the effects of walls with coefficients of their own. A coefficient that such a wall does not have is the one of all walls.
void add_wall_effects(const std::vector<Wall>& walls, std::vector<supernormal::effects::Effect>& effects);

}  // namespace falling_particles
