// Our bodies and dBox.
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/shape_of.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"

namespace supernormal::ode {

ContactManifold query_box(dGeomID ours, dGeomID collider, Goal goal) {
  const Box box = box_of(collider);
  const Vector3 lengths = 2 * box.half_lengths();
  const ColliderShape shape{collider, box, pose_of(collider), collider_kind(dBoxClass, {lengths[0], lengths[1], lengths[2]})};
  ContactManifold manifold = solve_pair(ours, shape, goal);
  if (manifold.reach > 0) return manifold;  // contacts ahead are on the body that moves
  // The contact is moved onto the box, where ODE's own contacts of dSphere and dBox are.
  const Vector3 onto_box = 0.5 * manifold.deepest.gap * manifold.deepest.normal;
  manifold.deepest.contact += onto_box;
  for (int k = 0; k < manifold.corner_count; ++k) manifold.corners[static_cast<std::size_t>(k)].point += onto_box;
  return manifold;
}

}  // namespace supernormal::ode
