#include "drive.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {

double push_of(const Drive& drive, double speed, double step) {
  if (drive.power == 0 || speed < 0) return drive.force;
  // The speed that has the energy of the end of the step. The power acts at the mean of both speeds.
  const double then = std::sqrt(speed * speed + 2 * step * drive.power / drive.mass);
  return std::min(drive.force, 2 * drive.power / (speed + then));
}

}  // namespace falling_particles
