// What runs may leave in the folder of their results.
#pragma once

#include "base/output_folder.hpp"

namespace falling_particles {

/// The tables, measurements and pictures of all scenes.
ResultNames result_names();

}  // namespace falling_particles
