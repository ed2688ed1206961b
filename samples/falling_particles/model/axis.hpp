// An axis of the world frame.
#pragma once

namespace falling_particles {

enum class Axis { X, Y, Z };

inline const char* name_of(Axis axis) { return axis == Axis::X ? "x" : axis == Axis::Y ? "y" : "z"; }

}  // namespace falling_particles
