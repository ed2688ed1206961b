#include "ode/solve_pair.hpp"

#include "ode/body.hpp"
#include "ode/convert.hpp"
#include "ode/statistics.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/solvers/solve.hpp"

namespace supernormal::ode {

ContactManifold solve_pair(dGeomID ours, const PartnerShape& partner, Goal goal) {
  const Body& body = require_body(ours);
  const Pose pose = pose_of(ours);
  const RelativePose relative_pose = RelativePose::of(partner.pose, pose);
  const PairKey key = PairKey::of_direction(body.serial(), relative_pose.offset, partner.kind);
  Vector3 first_normal;
  const bool warm = recall_normal(reserve_entry(key), relative_pose, body.size(), first_normal);
  if (warm) first_normal = pose.rotation.transpose() * (partner.pose.rotation * first_normal);
  const Settings settings = for_goal(body.settings(), goal);
  const Proximity result =
      find_proximity(body.shape(), pose, partner.shape, partner.pose, settings, warm ? &first_normal : nullptr);
  count_query(result, warm);
  if (result.status != Status::InvalidInput) {
    fill_entry(key, relative_pose, partner.pose.rotation.transpose() * result.normal);
  }
  return goal == Goal::Contacts ? find_contact_manifold(body.shape(), pose, partner.shape, partner.pose, result)
                                : ContactManifold(result);
}

}  // namespace supernormal::ode
