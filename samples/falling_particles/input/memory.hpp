// The memory that a run needs.
#pragma once

namespace falling_particles {

/// Bytes that a run with this many grains takes once they lie in a bed. A grain has 2 KiB of its own: body, geom, mass, start. In
/// a bed of mixed grains it has half of seven neighbours' bounding boxes to meet, each pair with room for five contacts (0.8
/// KiB); three contacts with their joints (0.6 KiB); and nine rows of quickstep (0.3 KiB), eighteen with rolling and spinning
/// resistance. Measured in a bed of 5000 are 12 KiB a grain. The rest is margin.
double memory_needed(int grains);

/// The most grains that memory_needed() has room for.
int most_grains(double bytes);

/// Bytes: the machine's memory, or the limit of this process (ulimit -v, -d) where that is lower.
double memory_of_machine();

}  // namespace falling_particles
