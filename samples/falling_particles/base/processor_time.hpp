// Processor time. Other programs lengthen wall-clock time, but not processor time.
#pragma once

#include <ctime>

namespace falling_particles {

/// s, of this process so far; resolution 1 us.
inline double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace falling_particles
