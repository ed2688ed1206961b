// Our bodies and dCapsule.
#include "supernormal/shapes/capsule.hpp"

#include "ode/colliders/collider.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

ContactManifold query_capsule(dGeomID ours, dGeomID collider, Goal goal) {
  dReal radius = 0;
  dReal length = 0;
  dGeomCapsuleGetParams(collider, &radius, &length);
  const Capsule capsule(radius, 0.5 * double{length});
  const ColliderShape shape{collider, capsule, pose_of(collider), collider_kind(dCapsuleClass, {radius, length})};
  return solve_pair(ours, shape, goal);
}

}  // namespace supernormal::ode
