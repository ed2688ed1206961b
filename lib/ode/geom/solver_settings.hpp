// Solver settings of geoms and of pairs, and their defaults.
#pragma once

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// The settings of new geoms. Thread-safe.
Settings default_settings();
void set_default_settings(const Settings& settings);

/// The settings of a pair: the tighter tolerance and the larger limit. The solver is the common one, or the hybrid if they differ.
Settings combined(const Settings& settings1, const Settings& settings2);

}  // namespace supernormal::ode
