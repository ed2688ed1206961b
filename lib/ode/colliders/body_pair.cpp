#include "ode/colliders/body_pair.hpp"

#include <algorithm>
#include <utility>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/runtime/statistics.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::ode {

BodyPair::BodyPair(dGeomID g1, dGeomID g2)
    : geom1_(g1),
      geom2_(g2),
      body1_(&require_body(g1)),
      body2_(&require_body(g2)),
      is_swapped_(body2_->serial() < body1_->serial()) {
  if (!is_swapped_) return;
  std::swap(geom1_, geom2_);
  std::swap(body1_, body2_);
}

PairKey BodyPair::key() const { return PairKey::of_bodies(body1_->serial(), body2_->serial()); }

ContactManifold BodyPair::solve_in_order(const Remembered& remembered, Goal goal, LastNormal& last) const {
  const Pose pose1 = pose_of(geom1_);
  const Pose pose2 = pose_of(geom2_);
  last.pose = RelativePose::of(pose1, pose2);
  Vector3 first_normal;
  const bool warm = recall_normal(remembered, last.pose, std::min(body1_->size(), body2_->size()), first_normal);
  const Settings settings = for_goal(combined(body1_->settings(), body2_->settings()), goal);
  const Proximity result = find_proximity(body1_->shape(), pose1, body2_->shape(), pose2, settings, warm ? &first_normal : nullptr);
  count_query(result, warm);
  last.is_known = result.status != Status::InvalidInput;
  last.normal = pose1.rotation.transpose() * result.normal;
  return goal == Goal::Contacts ? find_contact_manifold(body1_->shape(), pose1, body2_->shape(), pose2, result)
                                : ContactManifold(result);
}

ContactManifold BodyPair::solve(const Remembered& remembered, Goal goal, LastNormal& last) const {
  ContactManifold patch = solve_in_order(remembered, goal, last);
  if (is_swapped_) {
    patch.deepest.normal = -patch.deepest.normal;
    patch.deepest.point1.swap(patch.deepest.point2);
  }
  return patch;
}

}  // namespace supernormal::ode
