// What a query of a pair is for.
#pragma once

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// Colliders want overlaps only: they stop at the first normal that proves separation.
enum class Goal {
  OneContact,  ///< the deepest point
  Contacts,    ///< and the corners of a wide overlap
  Distance,
  CertifiedDistance,  ///< with a proof that of overlapping bodies the depth is the smallest
};

inline Settings for_goal(Settings settings, Goal goal) {
  settings.stop_when_apart = goal == Goal::OneContact || goal == Goal::Contacts;
  settings.certify_depth = goal == Goal::CertifiedDistance;
  return settings;
}

}  // namespace supernormal::ode
