#include "feeder.hpp"

#include <algorithm>
#include <cmath>

#include "common/interval.hpp"
#include "grain_shape.hpp"
#include "scene.hpp"

namespace falling_particles {
namespace {

/// An upper bound of the number of grains that a quantity contains, if all are of the lightest kind.
double most_grains(const Quantity& quantity, double lightest) {
  return quantity.of == Quantity::Of::Grains ? quantity.number : quantity.number / lightest + 1;
}

double smallest_mass(const GrainCount& entry) { return std::pow(entry.smallest_scale(), 3) * mass_of(entry.kind); }

}  // namespace

std::string Quantity::in_words() const { return shortest(number) + (of == Of::Mass ? " kg" : number == 1 ? " grain" : " grains"); }

double lightest_grain(const Feeder& feeder, const Scene& scene) {
  double lightest = INFINITY;
  for (const FedKind& fed : feeder.mixture) lightest = std::min(lightest, smallest_mass(scene.kinds[fed.kind]));
  return lightest;
}

double most_grains(const Feeder& feeder, const Scene& scene) {
  const double lightest = lightest_grain(feeder, scene);
  const double on = std::max(0.0, std::min(feeder.until, scene.time.duration) - feeder.from);
  double most = most_grains({feeder.rate.number * on, feeder.rate.of}, lightest);
  if (feeder.total) most = std::min(most, most_grains(*feeder.total, lightest));
  return std::ceil(1.001 * most) + 1;  // the geom's mass may differ in the last digits
}

double most_fed(const Scene& scene) {
  double most = 0;
  for (const Feeder& feeder : scene.feeders) most += most_grains(feeder, scene);
  return most;
}

}  // namespace falling_particles
