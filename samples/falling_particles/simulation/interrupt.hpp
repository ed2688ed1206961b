// Interruption of a run by the user.
#pragma once

namespace falling_particles {

/// From now on the first Ctrl-C (SIGINT) or SIGTERM only raises a flag; a second one ends the program as usual.
void catch_interrupts();

bool interrupted();

}  // namespace falling_particles
