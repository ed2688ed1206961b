// Our bodies among themselves.
#include "ode/colliders/body_pair.hpp"
#include "ode/colliders/collider.hpp"

namespace supernormal::ode {

ContactManifold query_body(dGeomID ours, dGeomID collider, Goal goal) {
  const BodyPair pair(ours, collider);
  const PairKey key = pair.key();
  LastNormal last;
  ContactManifold patch = pair.solve(reserve_entry(key), goal, last);
  last.remember(key);
  return patch;
}

}  // namespace supernormal::ode
