// Interruption of a run by the user.
#pragma once

namespace falling_particles {

/// Lowers the flag. From now on the first Ctrl-C (SIGINT) or SIGTERM only raises it; a second one ends the program as usual.
void catch_interrupts();

bool interrupted();

/// The same for a run that can go on from its checkpoints only: the signal leaves interrupted() as it is, prints `note` to stderr
/// and raises the flag of stop_requested(), which the run asks at its checkpoints. An interrupt that came before counts as such.
/// `note`: a text that stays.
void catch_stop_requests(const char* note);

bool stop_requested();

}  // namespace falling_particles
