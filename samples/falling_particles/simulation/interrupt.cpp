#include "interrupt.hpp"

#include <csignal>

namespace falling_particles {
namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

extern "C" void raise_flag(int) { interrupt_flag = 1; }

}  // namespace

void catch_interrupts() {
  interrupt_flag = 0;
  struct sigaction action {};
  action.sa_handler = raise_flag;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_flag != 0; }

}  // namespace falling_particles
