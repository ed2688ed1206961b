#include "ode/colliders/solve_pair.hpp"

#include <algorithm>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/geom/solver_settings.hpp"
#include "ode/runtime/statistics.hpp"
#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::ode {
namespace {

struct PosedShape {
  dGeomID geom;
  const Shape& shape;
  const Pose& pose;
};

BodyAhead moving(const PosedShape& posed) {
  return {posed.shape, posed.pose, motion_ahead_of(posed.geom, posed.pose.position, posed.shape.bounding_radius())};
}

/// Solves two shapes. `last.pose` must be set. The cached normal is in a frame with the orientation `frame`. `size` goes to
/// find_cached_normal(). Contacts are predicted `time` (s) ahead.
ContactManifold solve(const PosedShape& one, const PosedShape& other, const Settings& settings, QueryKind kind, double time,
                      const Matrix3& frame, double size, const CachedNormal& cached, LastNormal& last) {
  Vector3 first_normal;
  const bool is_warm = find_cached_normal(cached, last.pose, size, first_normal);
  // The solver expects the normal in the frame of the first shape.
  if (is_warm && &frame != &one.pose.rotation) first_normal = one.pose.rotation.transpose() * (frame * first_normal);
  const bool looks_ahead = time > 0 && is_for_contacts(kind);
  const Settings asked = settings_for(settings, looks_ahead ? QueryKind::Distance : kind);
  const Proximity result = find_proximity(one.shape, one.pose, other.shape, other.pose, asked, is_warm ? &first_normal : nullptr);
  last.is_known = result.status != Status::InvalidInput;
  last.normal.noalias() = frame.transpose() * result.normal;
  if (looks_ahead) {
    ContactManifold ahead = find_contacts_ahead(moving(one), moving(other), time, asked, result);
    count_query(ahead.deepest, is_warm);
    return ahead;
  }
  count_query(result, is_warm);
  return kind == QueryKind::Contacts ? find_contact_manifold(one.shape, one.pose, other.shape, other.pose, result)
                                     : ContactManifold(result);
}

}  // namespace

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

ContactManifold BodyPair::solve(const CachedNormal& cached, QueryKind kind, LastNormal& last) const {
  const Pose pose1 = pose_of(geom1_);
  const Pose pose2 = pose_of(geom2_);
  last.pose = RelativePose::of(pose1, pose2);
  const double time = std::max(body1_->look_ahead(), body2_->look_ahead());
  const PosedShape one{geom1_, body1_->shape(), pose1};
  const PosedShape other{geom2_, body2_->shape(), pose2};
  ContactManifold manifold = ode::solve(one, other, combined(body1_->settings(), body2_->settings()), kind, time, pose1.rotation,
                                        std::min(body1_->size(), body2_->size()), cached, last);
  if (is_swapped_) {
    manifold.deepest.normal = -manifold.deepest.normal;
    manifold.deepest.point1.swap(manifold.deepest.point2);
  }
  return manifold;
}

ContactManifold solve_pair(dGeomID ours, const ColliderShape& collider, QueryKind kind) {
  const Body& body = require_body(ours);
  const Pose pose = pose_of(ours);
  LastNormal last;
  last.pose = RelativePose::of(collider.pose, pose);
  const PairKey key = PairKey::of_direction(body.serial(), last.pose.offset, collider.kind);
  const double time = body.look_ahead();
  const PosedShape one{ours, body.shape(), pose};
  const PosedShape other{collider.geom, collider.shape, collider.pose};
  ContactManifold manifold =
      solve(one, other, body.settings(), kind, time, collider.pose.rotation, body.size(), reserve_entry(key), last);
  last.store(key);
  return manifold;
}

}  // namespace supernormal::ode
