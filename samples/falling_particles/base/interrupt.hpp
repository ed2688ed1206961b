// Interruption of a run by the user.
#pragma once

namespace falling_particles {

/// Lowers the flag and installs the handlers. The first Ctrl-C (SIGINT) or SIGTERM then raises the flag. A second one ends the
/// program as usual.
void catch_interrupts();

bool interrupted();

/// Does the same for a run that can be resumed from its checkpoints only. The signal does not change interrupted(): it prints
/// `note` to stderr and raises the flag of stop_requested(). The run checks this flag at its checkpoints. An earlier interrupt
/// counts as a stop request. `note` must stay valid.
void catch_stop_requests(const char* note);

bool stop_requested();

}  // namespace falling_particles
