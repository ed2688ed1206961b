// Our bodies and dPlane, the half-space n.x <= d.
#include "ode/body.hpp"
#include "ode/convert.hpp"
#include "ode/partner.hpp"
#include "ode/statistics.hpp"
#include "supernormal/solvers/plane.hpp"

namespace supernormal::ode {

ContactManifold query_plane(dGeomID ours, dGeomID partner, Goal goal) {
  const Body& body = require_body(ours);
  dVector4 plane;
  dGeomPlaneGetParams(partner, plane);
  const Pose pose = pose_of(ours);
  const Proximity result = find_plane_proximity(body.shape(), pose, to_vector(plane), plane[3]);
  count_closed_form();
  return goal == Goal::Contacts ? find_plane_contact_manifold(body.shape(), pose, result) : ContactManifold(result);
}

}  // namespace supernormal::ode
