// The hardware and software of a measurement.
#pragma once

#include "common/measured_tables.hpp"

namespace accuracy_cost {

/// That of the build, and the versions of the measured libraries.
common::Environment environment();

}  // namespace accuracy_cost
