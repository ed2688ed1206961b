// Our bodies and dPlane, the half-space n.x <= d.
#include "supernormal/proximity/plane.hpp"

#include "ode/colliders/collider.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/runtime/statistics.hpp"
#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal::ode {

ContactManifold query_plane(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Body& body = require_body(ours);
  dVector4 plane;
  dGeomPlaneGetParams(collider, plane);
  const Pose pose = pose_of(ours);
  const Proximity result = find_plane_proximity(body.shape(), pose, to_vector(plane), plane[3]);
  count_closed_form();
  if (body.look_ahead() > 0 && is_for_contacts(kind)) {
    const MotionAhead motion = motion_ahead_of(ours, pose.position, body.shape().bounding_radius(), body.look_ahead());
    return find_plane_contacts_ahead({body.shape(), pose, motion}, body.look_ahead(), result);
  }
  return kind == QueryKind::Contacts ? find_plane_contact_manifold(body.shape(), pose, result) : ContactManifold(result);
}

}  // namespace supernormal::ode
