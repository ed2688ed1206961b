#include "supernormal/raycast/ray.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/usable_pose.hpp"
#include "proximity/gap/usable_settings.hpp"
#include "proximity/search/answer.hpp"
#include "raycast/ray_entry.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace supernormal {
namespace {

void check(const Vector3& direction, double length, const Settings& settings) {
  require_in_range(settings);
  require_in("length of the ray", length, 0, std::numeric_limits<double>::infinity(), "m");
  require_unit("the ray's direction", direction);
}

/// A ray in the body's frame: its origin is foot + start v. The foot is the point of the line nearest to the body's origin. So a
/// ray from far away loses no digits near the body.
struct LocalRay {
  Vector3 v, foot;
  double start, end;  // m; from the foot, along v

  LocalRay(const Pose& pose, const Vector3& origin, const Vector3& direction, double length)
      : v((pose.rotation.transpose() * direction).normalized()) {
    const Vector3 o = pose.rotation.transpose() * (origin - pose.position);
    start = o.dot(v);
    end = start + length;
    foot = o - start * v;
    foot -= foot.dot(v) * v;
  }
};

/// Answers a ray query in two parts: where the line enters the body and, if the origin lies behind the entry, where it leaves.
class RayQuery {
 public:
  RayQuery(const Shape& shape, const LocalRay& ray, const Settings& settings)
      : ray_(ray),
        point_(0),
        gap_(shape, {}, point_, {ray.foot, Matrix3::Identity()}),
        settings_(settings),
        half_extents_(shape.half_extents()) {}

  bool is_finite() const { return gap_.is_finite() && std::abs(ray_.start) < kFarthest && all_finite(ray_.v); }

  RayHit run() {
    if (ray_.start <= 0) return from_entry();
    // The foot lies behind the origin, so the body probably does too. One plane settles most of these rays.
    const EntrySearch::Result exit = search(-ray_.v, -ray_.start);
    if (exit.status == Status::InvalidInput || exit.kind != EntrySearch::Kind::Found) return miss(exit.status);
    const EntrySearch::Result entry = search(ray_.v, ray_.end);
    if (is_behind(entry)) return leaving(exit);
    return entering(entry);
  }

 private:
  RayHit from_entry() {
    const EntrySearch::Result entry = search(ray_.v, ray_.end);
    if (!is_behind(entry)) return entering(entry);
    const EntrySearch::Result exit = search(-ray_.v, -ray_.start);
    return exit.kind == EntrySearch::Kind::Found ? leaving(exit) : miss(exit.status);
  }

  EntrySearch::Result search(const Vector3& direction, double limit) {
    EntrySearch search(gap_, direction, settings_);
    return search.run(first_entry_normal(half_extents_, ray_.foot, direction), limit);
  }

  bool is_behind(const EntrySearch::Result& entry) const { return entry.kind == EntrySearch::Kind::Found && entry.t < ray_.start; }

  RayHit entering(const EntrySearch::Result& entry) const {
    return entry.kind == EntrySearch::Kind::Found && entry.t <= ray_.end ? hit(entry, entry.t, false) : miss(entry.status);
  }

  /// The exit is the entry of the reversed line. For a line that only grazes the body, rounding may put the exit behind the origin.
  RayHit leaving(const EntrySearch::Result& exit) const {
    const double t = -exit.t;
    return ray_.start <= t && t <= ray_.end ? hit(exit, t, true) : miss(exit.status);
  }

  RayHit miss(Status status) const {
    RayHit out;
    out.evaluations = gap_.evaluations();
    out.status = status;
    return out;
  }

  RayHit hit(const EntrySearch::Result& boundary, double t, bool from_inside) const {
    RayHit out = miss(boundary.status);
    out.hit = true;
    out.from_inside = from_inside;
    out.distance = t - ray_.start;
    out.boundary_error = boundary.error;
    out.distance_error = boundary.t_error + std::numeric_limits<double>::epsilon() * (std::abs(t) + std::abs(ray_.start));
    out.point = ray_.foot + t * ray_.v;
    out.normal = boundary.normal;
    return out;
  }

  const LocalRay& ray_;
  Sphere point_;
  GapFunction gap_;
  const Settings& settings_;
  Vector3 half_extents_;
};

}  // namespace

RayHit find_ray_hit(const Shape& shape, const Pose& pose, const Vector3& origin, const Vector3& direction, double length,
                    const Settings& settings) {
  check(direction, length, settings);
  if (!is_usable(pose) || !all_within(origin, kFarthest) || !all_finite(direction)) return {};
  const LocalRay ray(pose, origin, direction, length);
  RayQuery query(shape, ray, settings);
  if (!query.is_finite()) return {};
  RayHit out = query.run();
  out.point = pose.rotation * out.point + pose.position;
  out.normal = (pose.rotation * out.normal).normalized();
  return out;
}

// The ray may be cut to a segment that fits in double precision. A point of the ray beyond twice `farthest` is farther from the
// body than the ray's origin. And the body clears the ray sideways before it clears such an end.
Proximity find_ray_proximity(const Shape& shape, const Pose& pose, const Vector3& origin, const Vector3& direction, double length,
                             const Settings& settings) {
  check(direction, length, settings);
  if (!is_usable(pose) || !all_within(origin, kFarthest) || !all_finite(direction)) return {};
  const double farthest = (origin - pose.position).norm() + shape.bounding_radius();
  if (!std::isfinite(farthest)) return {};
  const Vector3 v = direction.normalized();
  const double half_length = 0.5 * std::min(length, 2 * farthest);
  Pose segment_pose{origin + half_length * v, Matrix3::Identity()};
  segment_pose.rotation << v.unitOrthogonal(), v.cross(v.unitOrthogonal()), v;
  return find_proximity(shape, pose, Capsule(0, half_length), segment_pose, settings);
}

}  // namespace supernormal
