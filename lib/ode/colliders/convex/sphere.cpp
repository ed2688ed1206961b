// Our bodies and dSphere.
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/shape_of.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

// However the sphere is turned, it may be considered as fixed to the body: so it has the same pose as long as it is at the same
// place on the body. And the normals at which s has its maxima do not depend on the radius, so the last normal of any sphere at
// this place will do.
ContactManifold query_sphere(dGeomID ours, dGeomID collider, Goal goal) {
  const Sphere sphere = sphere_of(collider);
  const Pose pose{to_vector(dGeomGetPosition(collider)), rotation_of(ours)};
  return solve_pair(ours, {collider, sphere, pose, collider_kind(dSphereClass, {})}, goal);
}

}  // namespace supernormal::ode
