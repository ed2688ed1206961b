// Processor time, which other programs do not lengthen as they do that of the clock on the wall.
#pragma once

#include <ctime>

namespace falling_particles {

/// s, of this process so far; to a microsecond.
inline double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace falling_particles
