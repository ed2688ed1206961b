// Part of every program of this folder (CMakeLists.txt): at its end it says on stderr, and by exit code 1 instead of 0, that stdout
// has not taken all that was written, because it is closed or the disk is full. Other files that do not fit are errors of their
// writes.
#define _GNU_SOURCE  // on_exit, program_invocation_short_name

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

// `code`: the program's exit code. It is kept if it reports another failure.
static void check(int code, void* nothing) {
  (void)nothing;
  if (fflush(stdout) == 0 && ferror(stdout) == 0) return;
  fprintf(stderr, "%s: cannot write to stdout (is it closed, or the disk full?)\n", program_invocation_short_name);
  _exit(code == EXIT_SUCCESS ? EXIT_FAILURE : code);
}

// Opens streams that are closed, because a file that is opened while stdin, stdout or stderr is closed would take its number, and
// get the printed text.
__attribute__((constructor)) static void begin(void) {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    // The lowest free number is taken; writing to it fails.
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDONLY) < 0) abort();
  }
  signal(SIGXFSZ, SIG_IGN);  // what does not fit `ulimit -f` is an error of its write
  if (on_exit(check, NULL) != 0) abort();
}
