// The cost of accuracy in a simulation: a scene of grains in the form of several classes.
#pragma once

#include <string>

#include "atlas.hpp"

namespace accuracy_cost {

/// Measures the time per step of a settled bed of 1000 grains, ours and ODE's classes, all in one run.
Part scene_forms(const std::string& scene_path);

/// Measures the time per step of 500 to 20 000 grains in every space of ODE.
Part scene_growth(const std::string& scene_path);

/// Lets 1000 grains fall at every tolerance and number of vertices: measures the cost, and how the resulting beds differ.
Part scene_outcomes(const std::string& scene_path);

}  // namespace accuracy_cost
