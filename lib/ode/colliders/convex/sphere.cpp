// Our bodies and dSphere.
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/shape_of.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

// The rotation of a sphere is irrelevant, so the sphere gets the rotation of our body. Its relative pose then changes only when its
// centre moves relative to the body. The maxima of s(n) do not depend on the radius: any sphere with this centre can use the cached
// normal.
ContactManifold query_sphere(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Sphere sphere = sphere_of(collider);
  const Pose pose{to_vector(dGeomGetPosition(collider)), rotation_of(ours)};
  return solve_pair(ours, {collider, sphere, pose, collider_kind(dSphereClass, {})}, kind);
}

}  // namespace supernormal::ode
