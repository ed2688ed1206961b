// Pairs that are solved as two shapes of the core with a warm start: our bodies with each other, and our bodies with the geoms of
// ODE that are convex shapes.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <utility>

#include "ode/colliders/collider.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"
#include "supernormal/contact/contact_manifold.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

class Body;

/// What a query stores in the warm-start table.
struct LastNormal {
  bool is_known = false;  ///< false: the query had no result
  RelativePose pose;
  Vector3 normal = Vector3::UnitX();
  double gap = 0;  ///< m; proved at this normal, or 0

  CachedNormal entry() const { return CachedNormal::of(pose, normal, gap); }
  void store(const PairKey& key) const {
    if (is_known) fill_entry(key, entry());
  }
};

/// A query of a pair of our bodies, between BodyPair::prepare() and BodyPair::finish().
struct PreparedPair {
  Pose pose1, pose2;
  Settings settings;
  Vector3 first_normal = Vector3::UnitX();  ///< in the frame of body 1
  bool is_warm = false;                     ///< whether first_normal is known
  bool poses_are_usable = true;             ///< ProximityQuery::poses_are_usable
  double least_gap = 0;                     ///< m; > 0: first_normal still separates the bodies, and there is nothing to ask
};

/// A pair of our bodies. Body 1 of the query is the older body, in either order of the arguments. Spaces pass a pair in either
/// order, and both orders give the same digits.
class BodyPair {
 public:
  /// Throws std::invalid_argument when a geom is empty (dCreateGeom).
  BodyPair(dGeomID g1, dGeomID g2);

  PairKey key() const;
  std::pair<dGeomID, dGeomID> geoms() const { return is_swapped_ ? std::pair(geom2_, geom1_) : std::pair(geom1_, geom2_); }

  /// The result as seen from g1. Reads only the two geoms and changes only the statistics of this thread: pairs may be solved in
  /// parallel while no geom moves.
  ContactManifold solve(const CachedNormal& cached, QueryKind kind, LastNormal& last) const;

  /// The parts of solve(), for many pairs at once: finish() takes the answer to query_of(prepared), unless prepared.least_gap > 0.
  PreparedPair prepare(const CachedNormal& cached, QueryKind kind, LastNormal& last) const;
  ProximityQuery query_of(const PreparedPair& prepared) const;
  ContactManifold finish(const PreparedPair& prepared, const Proximity& found, QueryKind kind, LastNormal& last) const;
  static ContactManifold finish_apart(const PreparedPair& prepared, LastNormal& last);

 private:
  dGeomID geom1_, geom2_;
  const Body* body1_;
  const Body* body2_;
  bool is_swapped_;

  double look_ahead() const;  // s
};

/// A geom of ODE as a shape of the core.
struct ColliderShape {
  dGeomID geom;
  const Shape& shape;
  TestedPose pose;
  std::uint32_t kind;  ///< collider_kind()
};

/// Solves the pair of a body of ours and such a collider, with a warm start if a normal is cached. Counts the query.
///
/// The cached normal is in the frame of the collider. The key is the direction from the collider to our body. So a body on a dBox
/// floor, or rolling along a wall, keeps its normal and nearly its key, at any rotation.
ContactManifold solve_pair(dGeomID ours, const ColliderShape& collider, QueryKind kind);

}  // namespace supernormal::ode
