// Solver settings of geoms, of pairs and the default.
#pragma once

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// Of the geoms created from now on; any thread may ask and set them.
Settings default_settings();
void set_default_settings(const Settings& settings);

/// The tighter tolerance and the larger limit of both; their solver if they agree on one, the hybrid if not.
Settings combined(const Settings& settings1, const Settings& settings2);

}  // namespace supernormal::ode
