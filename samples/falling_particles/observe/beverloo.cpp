#include "beverloo.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {

double beverloo_mass_flow(double outlet, double grain_diameter, double bulk_density, double gravity) {
  const double effective = std::max(0.0, outlet - kBeverlooK * grain_diameter);
  return kBeverlooC * bulk_density * std::sqrt(gravity) * std::pow(effective, 2.5);
}

}  // namespace falling_particles
