// Solver settings of geoms, of pairs and the default.
#pragma once

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// What a query is for. Colliders want overlaps only: they stop at the first normal that proves separation.
enum class Goal {
  OneContact,  ///< the deepest point
  Contacts,    ///< and the corners of a wide overlap
  Distance,
  CertifiedDistance,  ///< with a proof that of overlapping bodies the depth is the smallest
};

/// Of the geoms created from now on; any thread may ask.
Settings default_settings();

/// The tighter tolerance and the larger limit of both; their solver if they agree on one, the hybrid if not.
Settings combined(const Settings& settings1, const Settings& settings2);

inline Settings for_goal(Settings settings, Goal goal) {
  settings.stop_when_apart = goal == Goal::OneContact || goal == Goal::Contacts;
  settings.certify_depth = goal == Goal::CertifiedDistance;
  return settings;
}

}  // namespace supernormal::ode
