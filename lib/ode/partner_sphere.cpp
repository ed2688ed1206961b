// Our bodies and dSphere.
#include "ode/body.hpp"
#include "ode/contact.hpp"
#include "ode/convert.hpp"
#include "ode/last_error.hpp"
#include "ode/partner.hpp"
#include "ode/statistics.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/solvers/solve.hpp"

namespace supernormal::ode {

Proximity query_sphere(dGeomID ours, dGeomID partner, Goal goal) {
  const Body& body = require_body(ours);
  const Pose pose = pose_of(ours);
  const Sphere sphere(dGeomSphereGetRadius(partner));
  const Pose sphere_pose{to_vector(dGeomGetPosition(partner)), Matrix3::Identity()};  // however it is turned

  // The normals at which s has its maxima do not depend on the radius: any sphere that has come to this place will do.
  const RelativePose relative_pose = {pose.rotation.transpose() * (sphere_pose.position - pose.position)};
  const PairKey key = PairKey::of_direction(body.serial(), relative_pose.offset);
  Vector3 first_normal;
  const bool warm = recall_normal(key, relative_pose, body.size(), first_normal);
  const Settings settings = for_goal(body.settings(), goal);
  const Proximity result = find_proximity(body.shape(), pose, sphere, sphere_pose, settings, warm ? &first_normal : nullptr);
  count_query(result, warm);
  if (result.status != Status::InvalidInput) remember_normal(key, relative_pose, pose.rotation.transpose() * result.normal);
  return result;
}

int collide_with_sphere(dGeomID ours, dGeomID partner, int flags, dContactGeom* contacts, int skip) {
  return guarded("dCollide", 0, [&] {
    const Proximity proximity = query_sphere(ours, partner, Goal::Contact);
    return write_contacts(proximity, {ours, partner, flags, contacts, skip});
  });
}

}  // namespace supernormal::ode
