// Our bodies among themselves.
#include "ode/body_pair.hpp"
#include "ode/partner.hpp"

namespace supernormal::ode {

ContactManifold query_body(dGeomID ours, dGeomID partner, Goal goal) {
  const BodyPair pair(ours, partner);
  const PairKey key = pair.key();
  LastNormal last;
  ContactManifold patch = pair.solve(reserve_entry(key), goal, last);
  last.remember(key);
  return patch;
}

}  // namespace supernormal::ode
