// Interruption of a run by the user.
#pragma once

namespace falling_particles {

/// Lowers the flag. From now on the first Ctrl-C (SIGINT) or SIGTERM only raises it; a second one ends the program as usual.
void catch_interrupts();

bool interrupted();

}  // namespace falling_particles
