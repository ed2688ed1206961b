// A query of two bodies of ours.
#pragma once

#include <ode/ode.h>

#include <utility>

#include "ode/runtime/solver_settings.hpp"
#include "ode/runtime/warm_start.hpp"
#include "supernormal/contact/contact_manifold.hpp"

namespace supernormal::ode {

class Body;

/// The result that the table of warm starts stores from a query.
struct LastNormal {
  bool is_known = false;  ///< false: the query had no result
  RelativePose pose;
  Vector3 normal = Vector3::UnitX();

  void remember(const PairKey& key) const {
    if (is_known) fill_entry(key, pose, normal);
  }
};

/// Body 1 of the query is the older one, whatever the caller's order: spaces pass a pair now in one order and now in the other,
/// and both give the same digits this way.
class BodyPair {
 public:
  /// Throws std::invalid_argument when one of them is empty (dCreateGeom).
  BodyPair(dGeomID g1, dGeomID g2);

  PairKey key() const;
  std::pair<dGeomID, dGeomID> geoms() const { return is_swapped_ ? std::pair(geom2_, geom1_) : std::pair(geom1_, geom2_); }

  /// The result as seen from g1. It reads nothing but the two geoms and changes nothing but this thread's statistics: pairs may
  /// be solved on several threads while no geom moves.
  ContactManifold solve(const Remembered& remembered, Goal goal, LastNormal& last) const;

 private:
  ContactManifold solve_in_order(const Remembered& remembered, Goal goal, LastNormal& last) const;

  dGeomID geom1_, geom2_;
  const Body* body1_;
  const Body* body2_;
  bool is_swapped_;
};

}  // namespace supernormal::ode
