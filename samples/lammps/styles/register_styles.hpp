// Makes the styles of this folder known to LAMMPS.
#pragma once

#include "lammps.h"

namespace granular {

/// To be called before LAMMPS reads its input.
void register_styles(LAMMPS_NS::LAMMPS& lammps);

}  // namespace granular
