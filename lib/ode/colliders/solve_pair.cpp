#include "ode/colliders/solve_pair.hpp"

#include <algorithm>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/runtime/statistics.hpp"
#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::ode {
namespace {

struct PosedBody {
  dGeomID geom;
  const Shape& shape;
  const Pose& pose;
};

BodyAhead moving(const PosedBody& posed, double time) {
  return {posed.shape, posed.pose, motion_ahead_of(posed.geom, posed.pose.position, posed.shape.bounding_radius(), time)};
}

/// The settings of a query that predicts contacts `time` (s) ahead.
Settings settings_for(const Settings& settings, QueryKind kind, double time) {
  return settings_for(settings, time > 0 && is_for_contacts(kind) ? QueryKind::Distance : kind);
}

/// Contacts from the answer to a query. Sets the normal of `last`, which is in a frame with the orientation `frame`.
/// `first_normal`: where the query started, in that frame, or null.
ContactManifold finish(const PosedBody& one, const PosedBody& other, const Settings& asked, QueryKind kind, double time,
                       const Vector3* first_normal, const Matrix3& frame, const Proximity& found, LastNormal& last) {
  const bool is_warm = first_normal != nullptr;
  last.is_known = found.status != Status::InvalidInput;
  // A first normal that separates the bodies is the answer. It stays to the bit, as where the query is skipped (finish_apart).
  if (is_warm && found.status == Status::Apart && found.evaluations == 1) {
    last.normal = *first_normal;
  } else {
    last.normal.noalias() = frame.transpose() * found.normal;
  }
  if (found.status == Status::Apart) last.gap = found.gap;
  if (time > 0 && is_for_contacts(kind)) {
    ContactManifold ahead = find_contacts_ahead(moving(one, time), moving(other, time), time, asked, found);
    count_query(ahead.deepest, is_warm);
    return ahead;
  }
  count_query(found, is_warm);
  return kind == QueryKind::Contacts ? find_contact_manifold(one.shape, one.pose, other.shape, other.pose, found)
                                     : ContactManifold(found);
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

double BodyPair::look_ahead() const { return std::max(body1_->look_ahead(), body2_->look_ahead()); }

PreparedPair BodyPair::prepare(const CachedNormal& cached, QueryKind kind, LastNormal& last) const {
  const TestedPose pose1 = tested_pose_of(geom1_), pose2 = tested_pose_of(geom2_);
  PreparedPair query{pose1.pose, pose2.pose, settings_for(combined(body1_->settings(), body2_->settings()), kind, look_ahead())};
  query.poses_are_usable = pose1.is_usable && pose2.is_usable;
  last.pose = RelativePose::of(query.pose1, query.pose2);
  query.is_warm = find_cached_normal(cached, last.pose, std::min(body1_->size(), body2_->size()), query.first_normal);
  if (query.is_warm && query.settings.stop_when_apart && body1_->is_known() && body2_->is_known()) {
    query.least_gap = cached_separation(cached, last.pose, body1_->radius(), body2_->radius());
  }
  return query;
}

ProximityQuery BodyPair::query_of(const PreparedPair& prepared) const {
  return {&body1_->shape(),
          &prepared.pose1,
          &body2_->shape(),
          &prepared.pose2,
          prepared.is_warm ? &prepared.first_normal : nullptr,
          prepared.poses_are_usable};
}

ContactManifold BodyPair::finish(const PreparedPair& prepared, const Proximity& found, QueryKind kind, LastNormal& last) const {
  const PosedBody one{geom1_, body1_->shape(), prepared.pose1};
  const PosedBody other{geom2_, body2_->shape(), prepared.pose2};
  ContactManifold manifold = ode::finish(one, other, prepared.settings, kind, look_ahead(),
                                         prepared.is_warm ? &prepared.first_normal : nullptr, prepared.pose1.rotation, found, last);
  if (is_swapped_) {
    manifold.deepest.normal = -manifold.deepest.normal;
    manifold.deepest.point1.swap(manifold.deepest.point2);
  }
  return manifold;
}

// What a query that evaluates first_normal would answer and store.
ContactManifold BodyPair::finish_apart(const PreparedPair& prepared, LastNormal& last) {
  Proximity apart;
  apart.gap = last.gap = prepared.least_gap;
  apart.status = Status::Apart;
  last.is_known = true;
  last.normal = prepared.first_normal;
  count_query(apart, true);
  return apart;
}

ContactManifold BodyPair::solve(const CachedNormal& cached, QueryKind kind, LastNormal& last) const {
  const PreparedPair prepared = prepare(cached, kind, last);
  if (prepared.least_gap > 0) return finish_apart(prepared, last);
  return finish(prepared, find_proximity(query_of(prepared), prepared.settings), kind, last);
}

ContactManifold solve_pair(dGeomID ours, const ColliderShape& collider, QueryKind kind) {
  const Body& body = require_body(ours);
  const TestedPose pose = tested_pose_of(ours);
  LastNormal last;
  last.pose = RelativePose::of(collider.pose.pose, pose.pose);
  const PairKey key = PairKey::of_direction(body.serial(), last.pose.offset, collider.kind);
  const double time = body.look_ahead();
  const PosedBody one{ours, body.shape(), pose.pose};
  const PosedBody other{collider.geom, collider.shape, collider.pose.pose};
  const Matrix3& frame = other.pose.rotation;
  Vector3 cached_normal, first_normal;
  const bool is_warm = find_cached_normal(reserve_entry(key), last.pose, body.size(), cached_normal);
  // The solver expects the normal in the frame of the first shape.
  if (is_warm) first_normal = one.pose.rotation.transpose() * (frame * cached_normal);
  const Settings asked = settings_for(body.settings(), kind, time);
  const Proximity found = find_proximity({&one.shape, &one.pose, &other.shape, &other.pose, is_warm ? &first_normal : nullptr,
                                          pose.is_usable && collider.pose.is_usable},
                                         asked);
  ContactManifold manifold = finish(one, other, asked, kind, time, is_warm ? &cached_normal : nullptr, frame, found, last);
  last.store(key);
  return manifold;
}

ContactManifold query_body(dGeomID ours, dGeomID collider, QueryKind kind) {
  const BodyPair pair(ours, collider);
  const PairKey key = pair.key();
  LastNormal last;
  ContactManifold manifold = pair.solve(reserve_entry(key), kind, last);
  last.store(key);
  return manifold;
}

}  // namespace supernormal::ode
