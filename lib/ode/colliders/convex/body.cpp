// Pairs of our bodies.
#include "ode/colliders/collider.hpp"
#include "ode/colliders/solve_pair.hpp"

namespace supernormal::ode {

ContactManifold query_body(dGeomID ours, dGeomID collider, QueryKind kind) {
  const BodyPair pair(ours, collider);
  const PairKey key = pair.key();
  LastNormal last;
  ContactManifold manifold = pair.solve(reserve_entry(key), kind, last);
  last.store(key);
  return manifold;
}

}  // namespace supernormal::ode
