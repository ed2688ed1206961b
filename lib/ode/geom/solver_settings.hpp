// Solver settings of geoms and of pairs, and their defaults.
#pragma once

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// The settings of geoms that are created from now on; any thread may read and set them.
Settings default_settings();
void set_default_settings(const Settings& settings);

/// The tighter tolerance and the larger limit of both; their solver if they agree on one, the hybrid if not.
Settings combined(const Settings& settings1, const Settings& settings2);

}  // namespace supernormal::ode
