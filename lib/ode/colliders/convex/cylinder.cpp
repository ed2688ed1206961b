// Our bodies and dCylinder.
#include "supernormal/shapes/cylinder.hpp"

#include "ode/colliders/collider.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

ContactManifold query_cylinder(dGeomID ours, dGeomID collider, Goal goal) {
  dReal radius = 0;
  dReal length = 0;
  dGeomCylinderGetParams(collider, &radius, &length);
  const Cylinder cylinder(radius, 0.5 * double{length});
  const ColliderShape shape{collider, cylinder, pose_of(collider), collider_kind(dCylinderClass, {radius, length})};
  return solve_pair(ours, shape, goal);
}

}  // namespace supernormal::ode
