// Reads the sections of a scene file that name effects.
#pragma once

#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "base/toml_input.hpp"

namespace falling_particles {

/// The names of the sections of effects: those of supernormal::effects.
std::vector<std::string> effect_sections();

/// The keys of an effect's section, for users: the library's, with those that scenes have besides, and what holds without them.
std::string scene_parameters(const supernormal::effects::Description& effect);

/// Loads the effects whose sections the file has. Throws InputError. `smallest_half_axis`, m, is the length that [surface_layer]
/// refers to; `step`, s, is that of the scene.
std::vector<supernormal::effects::Effect> load_effects(const TomlTable& root, double smallest_half_axis, double step);

}  // namespace falling_particles
