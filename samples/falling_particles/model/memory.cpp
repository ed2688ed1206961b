#include "memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

namespace falling_particles {
namespace {

constexpr double kBytesPerGrain = 20 * 1024;
constexpr double kBytesOfProgram = 32 * 1024 * 1024;  // code, libraries, the table of warm starts

}  // namespace

double memory_needed(int grains) { return kBytesOfProgram + kBytesPerGrain * grains; }

int most_grains(double bytes) {
  const double grains = (bytes - kBytesOfProgram) / kBytesPerGrain;
  return static_cast<int>(std::clamp(grains, 0.0, static_cast<double>(std::numeric_limits<int>::max())));
}

double memory_of_machine() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  for (const auto kind : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(kind, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  }
  return bytes;
}

}  // namespace falling_particles
