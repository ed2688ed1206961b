// The kinds of measurements, each in a file of its own.
#pragma once

#include "measurement.hpp"

namespace falling_particles {

MeasurementKind contact_forces_kind();
MeasurementKind stress_kind();
MeasurementKind coordination_kind();
MeasurementKind fabric_kind();
MeasurementKind part_force_kind();
MeasurementKind grid_kind();
MeasurementKind nematic_order_kind();
MeasurementKind segregation_kind();
MeasurementKind surface_kind();

}  // namespace falling_particles
