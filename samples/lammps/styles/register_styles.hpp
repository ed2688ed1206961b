// Registers the styles of this folder with LAMMPS.
#pragma once

#include "lammps.h"

namespace granular {

/// Call it before LAMMPS reads its input.
void register_styles(LAMMPS_NS::LAMMPS& lammps);

}  // namespace granular
