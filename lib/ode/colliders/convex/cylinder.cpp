// Our bodies and dCylinder.
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/shape_of.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

ContactManifold query_cylinder(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Cylinder cylinder = cylinder_of(collider);
  const ColliderShape shape{collider, cylinder, pose_of(collider),
                            collider_kind(dCylinderClass, {cylinder.radius(), 2 * cylinder.half_length()})};
  return solve_pair(ours, shape, kind);
}

}  // namespace supernormal::ode
