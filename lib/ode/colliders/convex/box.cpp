// Our bodies and dBox.
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/shape_of.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

ContactManifold query_box(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Box box = box_of(collider);
  const Vector3 lengths = 2 * box.half_lengths();
  const ColliderShape shape{collider, box, pose_of(collider), collider_kind(dBoxClass, {lengths[0], lengths[1], lengths[2]})};
  return solve_pair(ours, shape, kind);
}

}  // namespace supernormal::ode
