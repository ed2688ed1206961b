// Reads the sections of a scene file that name effects.
#pragma once

#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "base/toml_input.hpp"
#include "model/scene.hpp"

namespace falling_particles {

/// The names of the sections of effects, from supernormal::effects.
std::vector<std::string> effect_sections();

/// The keys of an effect's section with their defaults, for users: the library's parameters and the additional keys of scenes.
std::string scene_parameters(const supernormal::effects::Description& effect);

/// Loads the effects whose sections the file has. Throws InputError. `smallest_half_axis` (m) is the unit of the depth of
/// [surface_layer]; `step` (s) and `solver` are the scene's.
std::vector<supernormal::effects::Effect> load_effects(const TomlTable& root, double smallest_half_axis, double step,
                                                       supernormal::effects::Solver solver);

/// Adds the effects of parts with coefficients of their own to the effects of the scene. Throws InputError if a coefficient
/// excludes one of these.
void load_wall_effects(const TomlTable& root, Scene& scene);

}  // namespace falling_particles
