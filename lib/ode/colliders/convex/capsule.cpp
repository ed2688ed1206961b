// Our bodies and dCapsule.
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/shape_of.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

ContactManifold query_capsule(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Capsule capsule = capsule_of(collider);
  const ColliderShape shape{collider, capsule, pose_of(collider),
                            collider_kind(dCapsuleClass, {capsule.radius(), 2 * capsule.half_length()})};
  return solve_pair(ours, shape, kind);
}

}  // namespace supernormal::ode
