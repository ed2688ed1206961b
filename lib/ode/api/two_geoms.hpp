// What the queries of two geoms share.
#pragma once

#include <ode/ode.h>

#include "ode/colliders/query_kind.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// Two geoms in the order in which the core asks about them: body 1 is ours.
struct TwoGeoms {
  dGeomID ours, collider;
  bool is_swapped = false;  ///< whether `ours` is the second argument

  /// Throws std::invalid_argument if one of the pointers is null, both geoms are the same, or none is ours.
  TwoGeoms(dGeomID g1, dGeomID g2, const void* out);

  const char* our_name() const { return is_swapped ? "g2" : "g1"; }       ///< the argument in messages
  const char* collider_name() const { return is_swapped ? "g1" : "g2"; }  ///< the argument in messages

  /// Throws std::invalid_argument with the reason why the core has no answer.
  [[noreturn]] void refuse() const;
};

/// Throws std::invalid_argument if the pair is not supported.
void require_supported(const TwoGeoms& geoms);

/// The answer of the core for two geoms. Throws std::invalid_argument if the pair is not supported or there is no answer.
Proximity find_proximity_of(const TwoGeoms& geoms, QueryKind kind);

}  // namespace supernormal::ode
