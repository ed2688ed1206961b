// Reads the [container] sections of moving containers.
#pragma once

#include "base/toml_input.hpp"
#include "model/moving.hpp"
#include "model/scene.hpp"

namespace falling_particles {

// Each throws InputError.
Drum read_drum(const TomlTable& table, const Time& time);
Tray read_tray(const TomlTable& table, const Time& time);
ShearCell read_shear_cell(const TomlTable& table, const Time& time);
ConveyorBelt read_conveyor_belt(const TomlTable& table, const Time& time);

}  // namespace falling_particles
