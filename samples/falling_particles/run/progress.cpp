#include "progress.hpp"

#include <unistd.h>

#include <string>

namespace falling_particles {
namespace {

constexpr std::size_t kBarWidth = 30;
constexpr auto kRedrawInterval = std::chrono::milliseconds(100);

}  // namespace

Progress::Progress(std::FILE* stream, int steps, int done)
    : stream_(stream),
      terminal_(isatty(fileno(stream)) == 1),
      steps_(steps),
      done_(done),
      start_(Clock::now()),
      last_draw_(start_) {}

void Progress::update(int step, double simulated, std::size_t contacts) {
  if (terminal_) {
    const Clock::time_point now = Clock::now();
    if (now - last_draw_ < kRedrawInterval && step < steps_) return;
    last_draw_ = now;
    draw(step, simulated, contacts);
    return;
  }
  const int tenths = static_cast<int>(10LL * step / steps_);
  if (tenths == tenths_) return;
  tenths_ = tenths;
  std::fprintf(stream_, "%3d %%  t = %.3f s  %zu contacts  %.0f s left\n", 10 * tenths, simulated, contacts, seconds_left(step));
  std::fflush(stream_);
}

void Progress::draw(int step, double simulated, std::size_t contacts) {
  const double share = static_cast<double>(step) / steps_;
  std::string bar(kBarWidth, '.');
  bar.replace(0, static_cast<std::size_t>(share * static_cast<double>(kBarWidth)),
              static_cast<std::size_t>(share * static_cast<double>(kBarWidth)), '#');
  // \033[K clears the rest of a longer line.
  std::fprintf(stream_, "\r[%s] %3.0f %%  t = %.3f s  %zu contacts  %.0f s left\033[K", bar.c_str(), 100 * share, simulated,
               contacts, seconds_left(step));
  std::fflush(stream_);
}

double Progress::seconds_left(int step) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  return elapsed * (steps_ - step) / (step - done_);
}

Progress::~Progress() {
  if (terminal_) std::fputc('\n', stream_);
}

}  // namespace falling_particles
