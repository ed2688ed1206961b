// The formats of pictures that a scene can ask for: [output] pictures = ["name", …].
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace falling_particles {

/// In the order in which they are listed for users. Each has an entry in picture_formats() (output/picture.hpp).
inline constexpr std::array<std::string_view, 6> kPictureNames = {"page", "glb", "lammps", "vtk", "povray", "plots"};

/// The formats that a run writes when its scene names none.
inline std::vector<std::string> default_pictures() { return {"page", "glb", "plots"}; }

}  // namespace falling_particles
