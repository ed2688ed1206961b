// Our bodies and dConvex: the convex hull of its vertices. Its polygons and planes are ignored.
#include "base/thread_kept.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/convex_vertices.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/warm_start.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal::ode {
namespace {

/// The vertices of this thread; kept to reuse their memory.
ConvexVertices& kept_vertices() {
  thread_local ThreadKept<ConvexVertices> kept;
  return *kept;
}

}  // namespace

ContactManifold query_convex(dGeomID ours, dGeomID collider, QueryKind kind) {
  ConvexVertices& vertices = kept_vertices();
  if (!vertices.read(collider)) return {};
  const Polytope hull(vertices.points());
  const ColliderShape shape{collider, hull, {vertices.pose(), false}, collider_kind(dConvexClass, {vertices.fingerprint()})};
  return solve_pair(ours, shape, kind);
}

}  // namespace supernormal::ode
