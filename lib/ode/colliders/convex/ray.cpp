// Our bodies and dRay.
//
// A contact of a ray is not an overlap: `depth` is the distance along the ray and `pos` the hit. The normal opposes the ray: it is
// the outward normal from outside, and the inward normal from inside. A ray of length 0 hits nothing. As with the convex geoms of
// ODE, firstContact, backfaceCull and closestHit have no effect.
#include "supernormal/raycast/ray.hpp"

#include "ode/colliders/collider.hpp"
#include "ode/colliders/contact.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/statistics.hpp"
#include "ode/support/last_error.hpp"

namespace supernormal::ode {
namespace {

/// A dRay. The rotation of the geom is not read, because dGeomRaySet writes only one column of it.
struct Ray {
  Vector3 origin, direction;
  double length;

  explicit Ray(dGeomID geom) : length(dGeomRayGetLength(geom)) {
    dVector3 start, along;
    dGeomRayGet(geom, start, along);
    origin = to_vector(start);
    direction = to_vector(along);
  }
};

/// The hit in the form that write_contacts() converts.
Proximity as_contact(const RayHit& hit) {
  Proximity contact;
  contact.gap = -hit.distance;
  contact.normal = hit.from_inside ? Vector3(-hit.normal) : hit.normal;
  contact.contact = hit.point;
  contact.evaluations = hit.evaluations;
  contact.status = hit.hit || hit.status != Status::Converged ? hit.status : Status::Apart;
  return contact;
}

}  // namespace

ContactManifold query_ray(dGeomID ours, dGeomID collider, QueryKind kind) {
  const Body& body = require_body(ours);
  const Ray ray(collider);
  const Settings settings = settings_for(body.settings(), kind);
  const Proximity result = find_ray_proximity(body.shape(), pose_of(ours), ray.origin, ray.direction, ray.length, settings);
  count_query(result, false);
  return result;
}

int collide_with_ray(dGeomID ours, dGeomID collider, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const Body& body = require_body(ours);
    const Ray ray(collider);
    if (!(ray.length > 0)) return 0;
    const RayHit hit = find_ray_hit(body.shape(), pose_of(ours), ray.origin, ray.direction, ray.length, body.settings());
    if (hit.status == Status::InvalidInput) refuse_pair(ours, collider);
    const Proximity contact = as_contact(hit);
    count_query(contact, false);
    return hit.hit ? write_contacts(contact, {ours, collider, flags, contacts, skip}) : 0;
  });
}

}  // namespace supernormal::ode
