// Our bodies and dConvex: the convex hull of its vertices, whatever its polygons and planes say.
#include "ode/convert.hpp"
#include "ode/convex_vertices.hpp"
#include "ode/partner.hpp"
#include "ode/solve_pair.hpp"
#include "ode/warm_start.hpp"
#include "shapes/face_normals.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal::ode {
namespace {

/// What a thread keeps from query to query.
struct Scratch {
  ConvexVertices vertices;
  FaceNormals face_normals;
};

Scratch& scratch() {
  thread_local Scratch kept;
  return kept;
}

}  // namespace

ContactManifold query_convex(dGeomID ours, dGeomID partner, Goal goal) {
  ConvexVertices& vertices = scratch().vertices;
  if (!vertices.read(partner)) return {};
  const Polytope hull(vertices.points(), scratch().face_normals.find(vertices.points()));
  const auto count = static_cast<double>(vertices.points().size());
  const PartnerShape shape{hull, vertices.pose(), partner_kind(dConvexClass, {count})};
  return solve_pair(ours, shape, goal);
}

}  // namespace supernormal::ode
