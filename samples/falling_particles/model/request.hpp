// A measurement that a scene requests.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace falling_particles {

class Measurement;
class World;

/// Makes a measurement for a world that has made no step.
using MeasurementMaker = std::function<std::unique_ptr<Measurement>(const World&)>;

/// A section [[measurement]] of a scene file, checked.
struct MeasurementRequest {
  std::string name;  ///< of its table, measurements/NAME.csv
  std::string kind;  ///< in measurement_kinds()
  int every;         ///< steps between two samples; samples are at multiples of it from `first` to `last`
  int first;         ///< in steps; at step 0 only kinds that need no contacts have a sample
  int last;
  bool needs_contacts;
  MeasurementMaker make;

  bool is_due(int step) const { return step % every == 0 && step >= first && step <= last; }
  bool follows(int step) const { return step > first && step <= last; }  ///< if the kind follows the run
};

}  // namespace falling_particles
