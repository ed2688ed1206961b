// Reads [container] sections of kinds that move.
#pragma once

#include "container/moving.hpp"
#include "scene.hpp"
#include "toml_input.hpp"

namespace falling_particles {

// Each throws InputError.
Drum read_drum(const TomlTable& table, const Time& time);
Tray read_tray(const TomlTable& table, const Time& time);
ShearCell read_shear_cell(const TomlTable& table, const Time& time);
ConveyorBelt read_conveyor_belt(const TomlTable& table, const Time& time);

}  // namespace falling_particles
