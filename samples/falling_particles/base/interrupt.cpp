#include "interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace falling_particles {
namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

volatile std::sig_atomic_t stop_flag = 0;
const char* volatile stop_note = "";

extern "C" void raise_flag(int) { interrupt_flag = 1; }

extern "C" void raise_stop_flag(int) {
  stop_flag = 1;
  if (write(STDERR_FILENO, stop_note, std::strlen(stop_note)) < 0) return;  // stderr is closed
}

void catch_signals(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

void catch_interrupts() {
  interrupt_flag = 0;
  catch_signals(raise_flag);
}

bool interrupted() { return interrupt_flag != 0; }

void catch_stop_requests(const char* note) {
  stop_flag = 0;
  stop_note = note;
  catch_signals(raise_stop_flag);
  if (interrupt_flag == 0) return;  // no interrupt was caught before
  stop_flag = 1;
  interrupt_flag = 0;
}

bool stop_requested() { return stop_flag != 0; }

}  // namespace falling_particles
