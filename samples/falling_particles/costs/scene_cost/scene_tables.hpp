// The cost of accuracy in a simulation: a scene of grains as bodies of several geometry classes.
#pragma once

#include <string>

#include "common/measured_tables.hpp"

namespace scene_cost {

/// Measures the time per step of a settled bed of 1000 grains, with our class and the classes of ODE, in one run.
common::MeasuredTable scene_forms(const std::string& scene_path);

/// Measures the time per step of 500 to 20 000 grains in every space of ODE.
common::MeasuredTable scene_growth(const std::string& scene_path);

/// Drops 1000 grains with every tolerance and number of vertices. Measures the cost and the differences of the final beds.
common::MeasuredTable scene_outcomes(const std::string& scene_path);

}  // namespace scene_cost
