#include "start_state.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {

double StartState::largest_speed() const {
  double largest = 0;
  for (const StartGrain& grain : grains) {
    largest = std::max(largest, std::hypot(grain.velocity[0], grain.velocity[1], grain.velocity[2]));
  }
  return largest;
}

}  // namespace falling_particles
