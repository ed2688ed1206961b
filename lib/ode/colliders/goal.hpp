// The purpose of a pair query.
#pragma once

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// The purpose of a query. Colliders need overlaps only: they stop at the first normal that proves separation.
enum class Goal {
  OneContact,  ///< the deepest point
  Contacts,    ///< the contact manifold
  Distance,
  CertifiedDistance,  ///< with a proof that the depth of overlapping bodies is minimal
};

/// Whether dCollide asks.
inline bool is_for_contacts(Goal goal) { return goal == Goal::OneContact || goal == Goal::Contacts; }

inline Settings for_goal(Settings settings, Goal goal) {
  settings.stop_when_apart = is_for_contacts(goal);
  settings.certify_depth = goal == Goal::CertifiedDistance;
  return settings;
}

}  // namespace supernormal::ode
