#include "measurement.hpp"

#include <algorithm>

#include "kinds.hpp"

namespace falling_particles {

const std::vector<MeasurementKind>& measurement_kinds() {
  static const std::vector<MeasurementKind> kinds = {contact_forces_kind(), coordination_kind(), fabric_kind(),
                                                     stress_kind(),         part_force_kind(),   grid_kind(),
                                                     nematic_order_kind(),  segregation_kind(),  surface_kind()};
  return kinds;
}

const MeasurementKind* find_measurement_kind(std::string_view name) {
  const auto found = std::ranges::find(measurement_kinds(), name, &MeasurementKind::name);
  return found == measurement_kinds().end() ? nullptr : &*found;
}

std::string list_measurements() {
  std::string text;
  for (const MeasurementKind& kind : measurement_kinds()) {
    text += "[[measurement]] kind = \"" + kind.name + "\"\n  measures    " + kind.measures + '\n';
    for (const MeasurementParameter& parameter : kind.parameters) {
      text += std::string("  ") + (&parameter == &kind.parameters.front() ? "parameters  " : "            ") + parameter.key +
              ": " + parameter.text + '\n';
    }
    text += "  columns     " + kind.columns + '\n';
    text += std::string("  cost        ") +
            (kind.needs_contacts ? "the forces of the sampled steps' joints" : "a pass over the grains") + "\n  source      " +
            kind.source + '\n';
  }
  return text;
}

}  // namespace falling_particles
