// The names of all results of runs.
#pragma once

#include "base/output_folder.hpp"

namespace falling_particles {

/// The tables, measurements and pictures of all scenes.
ResultNames result_names();

}  // namespace falling_particles
