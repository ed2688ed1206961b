// The memory that a run needs.
#pragma once

namespace falling_particles {

/// The bytes that a run with this many grains needs in a bed. Measured in a bed of 5000 grains are 12 KiB per grain; the rest is
/// margin. A grain has 2 KiB of its own: body, geom, mass and start. In a bed of mixed grains, the bounding boxes of seven
/// neighbours meet its own. So it has 3.5 pairs, each with max_contacts of five (0.8 KiB). It has three contacts with their joints
/// (0.6 KiB). Quickstep has nine rows for it (0.3 KiB), or eighteen with rolling and spinning resistance.
double memory_needed(int grains);

/// The most grains for which memory_needed() is at most `bytes`.
int most_grains(double bytes);

/// Bytes: the machine's memory, or the limit of this process (ulimit -v, -d) if it is lower.
double memory_of_machine();

}  // namespace falling_particles
