// Pairs that are solved as two shapes of the core, each from its last normal: our bodies among themselves, and our bodies with
// those of ODE's own geoms that are shapes of the core.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <utility>

#include "ode/colliders/collider.hpp"
#include "ode/runtime/warm_start.hpp"
#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

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

/// A pair of our bodies. Body 1 of the query is the older one, whatever the caller's order: spaces pass a pair now in one order
/// and now in the other, and both give the same digits this way.
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
  dGeomID geom1_, geom2_;
  const Body* body1_;
  const Body* body2_;
  bool is_swapped_;
};

/// One of ODE's own geoms as a shape of the core.
struct ColliderShape {
  dGeomID geom;
  const Shape& shape;
  Pose pose;
  std::uint32_t kind;  ///< collider_kind()
};

/// Solves the pair of a body of ours and such a collider, from its last normal if there is one, and counts the query.
///
/// The remembered normals are in the collider's own frame, and the key is the direction in which our body is seen from there: on
/// a floor made of a dBox or rolling along a wall a body has the same normal and nearly the same place, however it turns.
ContactManifold solve_pair(dGeomID ours, const ColliderShape& collider, Goal goal);

}  // namespace supernormal::ode
