// Our bodies and dConvex: the convex hull of its vertices, whatever its polygons and planes say.
#include "ode/convert.hpp"
#include "ode/convex_vertices.hpp"
#include "ode/partner.hpp"
#include "ode/solve_pair.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal::ode {
namespace {

/// This thread's, kept from query to query for the memory in it.
ConvexVertices& kept_vertices() {
  thread_local ConvexVertices kept;
  return kept;
}

}  // namespace

ContactManifold query_convex(dGeomID ours, dGeomID partner, Goal goal) {
  ConvexVertices& vertices = kept_vertices();
  if (!vertices.read(partner)) return {};
  const Polytope hull(vertices.points());
  const auto count = static_cast<double>(vertices.points().size());
  const PartnerShape shape{hull, vertices.pose(), partner_kind(dConvexClass, {count})};
  return solve_pair(ours, shape, goal);
}

}  // namespace supernormal::ode
