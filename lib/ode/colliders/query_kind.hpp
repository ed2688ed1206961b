// The kinds of pair queries.
#pragma once

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::ode {

/// The kind of a query. Queries for contacts need overlaps only, so they stop at the first normal that proves separation.
enum class QueryKind {
  OneContact,  ///< the deepest point
  Contacts,    ///< the contact manifold
  Distance,
  CertifiedDistance,  ///< with a proof that the depth of overlapping bodies is minimal
};

/// Whether it is a query of dCollide.
inline bool is_for_contacts(QueryKind kind) { return kind == QueryKind::OneContact || kind == QueryKind::Contacts; }

inline Settings settings_for(Settings settings, QueryKind kind) {
  settings.stop_when_apart = is_for_contacts(kind);
  settings.certify_depth = kind == QueryKind::CertifiedDistance;
  return settings;
}

}  // namespace supernormal::ode
