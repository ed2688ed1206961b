#include "ode/colliders/solve_pair.hpp"

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/statistics.hpp"
#include "ode/runtime/warm_start.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::ode {

ContactManifold solve_pair(dGeomID ours, const ColliderShape& collider, Goal goal) {
  const Body& body = require_body(ours);
  const Pose pose = pose_of(ours);
  const RelativePose relative_pose = RelativePose::of(collider.pose, pose);
  const PairKey key = PairKey::of_direction(body.serial(), relative_pose.offset, collider.kind);
  Vector3 first_normal;
  const bool warm = recall_normal(reserve_entry(key), relative_pose, body.size(), first_normal);
  if (warm) first_normal = pose.rotation.transpose() * (collider.pose.rotation * first_normal);
  const Settings settings = for_goal(body.settings(), goal);
  const Proximity result =
      find_proximity(body.shape(), pose, collider.shape, collider.pose, settings, warm ? &first_normal : nullptr);
  count_query(result, warm);
  if (result.status != Status::InvalidInput) {
    fill_entry(key, relative_pose, collider.pose.rotation.transpose() * result.normal);
  }
  return goal == Goal::Contacts ? find_contact_manifold(body.shape(), pose, collider.shape, collider.pose, result)
                                : ContactManifold(result);
}

}  // namespace supernormal::ode
