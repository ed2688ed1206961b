// Our bodies and dSphere, dBox, dCapsule and dCylinder.
#include <cstdint>

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

ContactManifold query_box(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Box box = box_of(collider);
  const Vector3 half = box.half_lengths();
  return solve_pair(ours, {collider, box, pose_of(collider), collider_kind(dBoxClass, {2 * half[0], 2 * half[1], 2 * half[2]})},
                    kind);
}

ContactManifold query_capsule(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Capsule capsule = capsule_of(collider);
  const std::uint32_t number = collider_kind(dCapsuleClass, {capsule.radius(), 2 * capsule.half_length()});
  return solve_pair(ours, {collider, capsule, pose_of(collider), number}, kind);
}

ContactManifold query_cylinder(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Cylinder cylinder = cylinder_of(collider);
  const std::uint32_t number = collider_kind(dCylinderClass, {cylinder.radius(), 2 * cylinder.half_length()});
  return solve_pair(ours, {collider, cylinder, pose_of(collider), number}, kind);
}

}  // namespace supernormal::ode
