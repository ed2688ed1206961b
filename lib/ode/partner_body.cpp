// Our bodies among themselves.
#include <algorithm>

#include "ode/body.hpp"
#include "ode/convert.hpp"
#include "ode/partner.hpp"
#include "ode/statistics.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/solvers/solve.hpp"

namespace supernormal::ode {
namespace {

ContactPatch query_in_order(const Body& body1, const Pose& pose1, const Body& body2, const Pose& pose2, Goal goal) {
  const PairKey key = PairKey::of_bodies(body1.serial(), body2.serial());
  const RelativePose relative_pose = RelativePose::of(pose1, pose2);
  Vector3 first_normal;
  const bool warm = recall_normal(key, relative_pose, std::min(body1.size(), body2.size()), first_normal);
  const Settings settings = for_goal(combined(body1.settings(), body2.settings()), goal);
  const Proximity result = find_proximity(body1.shape(), pose1, body2.shape(), pose2, settings, warm ? &first_normal : nullptr);
  count_query(result, warm);
  if (result.status != Status::InvalidInput) remember_normal(key, relative_pose, pose1.rotation.transpose() * result.normal);
  return goal == Goal::Contacts ? find_contact_patch(body1.shape(), pose1, body2.shape(), pose2, result) : ContactPatch(result);
}

ContactPatch seen_from_other(ContactPatch patch) {
  patch.deepest.normal = -patch.deepest.normal;
  patch.deepest.point1.swap(patch.deepest.point2);
  return patch;
}

}  // namespace

// The older body is body 1 whatever the caller's order: spaces pass a pair now in one order and now in the other, and both give
// the same digits this way.
ContactPatch query_body(dGeomID ours, dGeomID partner, Goal goal) {
  const Body& body1 = require_body(ours);
  const Body& body2 = require_body(partner);
  if (body1.serial() < body2.serial()) return query_in_order(body1, pose_of(ours), body2, pose_of(partner), goal);
  return seen_from_other(query_in_order(body2, pose_of(partner), body1, pose_of(ours), goal));
}

}  // namespace supernormal::ode
