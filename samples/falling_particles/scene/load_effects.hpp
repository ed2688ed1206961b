#pragma once

#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "toml_input.hpp"

namespace falling_particles {

/// The sections that name effects: those of supernormal::effects, each with its own name.
std::vector<std::string> effect_sections();

/// The effects whose sections the file has. Throws InputError. `smallest_half_axis`, m, is what [surface_layer] refers to; `step`,
/// s, is that of the scene.
std::vector<supernormal::effects::Effect> load_effects(const TomlTable& root, double smallest_half_axis, double step);

}  // namespace falling_particles
