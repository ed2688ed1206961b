#include "material.hpp"

#include <optional>

namespace falling_particles {
namespace {

namespace fx = supernormal::effects;

bool has_own_material(const Wall& wall) { return wall.friction.has_value() || wall.restitution.has_value(); }

/// The effect that the scene names for grains on walls.
template <typename E>
std::optional<E> of_walls(const std::vector<fx::Effect>& effects) {
  for (const fx::Effect& effect : effects) {
    const E* found = std::get_if<E>(&effect);
    if (found != nullptr && found->on == kGrainOnWall) return *found;
  }
  return std::nullopt;
}

/// The threshold of the restitution that the scene names; all contacts share it.
double threshold_of(const std::vector<fx::Effect>& effects) {
  for (const fx::Effect& effect : effects) {
    if (const auto* found = std::get_if<fx::Restitution>(&effect)) return found->threshold;
  }
  return 0;
}

}  // namespace

fx::Material material_of_wall(const std::vector<Wall>& walls, std::size_t index) {
  if (!has_own_material(walls[index])) return kWallMaterial;
  fx::Material material = kWallMaterial;
  for (std::size_t i = 0; i <= index; ++i) material += has_own_material(walls[i]) ? 1 : 0;
  return material;
}

void add_wall_effects(const std::vector<Wall>& walls, std::vector<fx::Effect>& effects) {
  const std::optional<fx::Friction> friction = of_walls<fx::Friction>(effects);
  const std::optional<fx::Restitution> restitution = of_walls<fx::Restitution>(effects);
  const double threshold = threshold_of(effects);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!has_own_material(walls[i])) continue;
    const auto on = fx::MaterialSelector::between(kGrainMaterial, material_of_wall(walls, i));
    if (walls[i].friction || friction)
      effects.emplace_back(fx::Friction{walls[i].friction.value_or(friction ? friction->coefficient : 0), on});
    if (walls[i].restitution || restitution) {
      effects.emplace_back(
          fx::Restitution{walls[i].restitution.value_or(restitution ? restitution->coefficient : 0), threshold, on});
    }
  }
}

}  // namespace falling_particles
