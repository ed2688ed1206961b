// What accuracy costs in a simulation: a scene of grains in the form of several classes.
#pragma once

#include <string>

#include "atlas.hpp"

namespace accuracy_cost {

/// The time per step of a settled bed of 1000 grains, ours and ODE's classes, all in one run.
Part scene_forms(const std::string& scene_path);

/// The time per step of 500 to 20 000 grains in every space of ODE.
Part scene_growth(const std::string& scene_path);

/// The fall of 1000 grains at every tolerance and number of vertices: what it costs, and how the bed that comes out of it differs.
Part scene_outcomes(const std::string& scene_path);

}  // namespace accuracy_cost
