// The materials of grains and walls.
#pragma once

#include <supernormal/effects.hpp>

namespace falling_particles {

constexpr supernormal::effects::Material kGrainMaterial = 0;
constexpr supernormal::effects::Material kWallMaterial = 1;
constexpr auto kGrainOnWall = supernormal::effects::MaterialSelector::between(kGrainMaterial, kWallMaterial);

}  // namespace falling_particles
