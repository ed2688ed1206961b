// Random pairs of bodies in motion, and a slow search for their first impact.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"
#include "support/long_body.hpp"

namespace supernormal::test {

struct MovingBody {
  std::shared_ptr<const Shape> shape;
  Motion motion;
};

/// How the bodies of a pair move.
struct MotionKind {
  const char* name;
  double speed;  ///< displacement within the horizon, relative to the distance of the bodies
  double turns;  ///< rad; rotation within the horizon
  bool is_off;   ///< they rotate about a point off their middle
};

inline constexpr MotionKind kMotionKinds[] = {{"straight", 2, 0, false},
                                              {"straight and turning", 2, 1, false},
                                              {"turning", 0, 3, true},
                                              {"a bullet that spins", 4, 20, false},
                                              {"a slow step", 0.05, 0.05, false},
                                              {"off its middle", 1, 3, true}};

struct MovingPair {
  MovingBody one, other;
  double horizon = 1;
  double unit = 0;  ///< m; the smallest half-extent
};

class RandomMotions : public Draw {
 public:
  using Draw::Draw;

  /// So that a seed gives the pairs of lib/impact/README.md.
  Matrix3 rotation() { return Eigen::Quaterniond{gauss(), gauss(), gauss(), gauss()}.normalized().toRotationMatrix(); }

  /// Needles, cans, cubes, bricks, coins, balls, ovals.
  std::shared_ptr<const Shape> shape() {
    const double a = uniform(0.5, 1.5);
    switch (whole(0, 8)) {
      case 0:
        return std::make_shared<Ellipsoid>(Vector3(a, a / 40, a / 40));
      case 1:
        return std::make_shared<Cylinder>(a, uniform(0.2, 2));
      case 2:
        return std::make_shared<Box>(Vector3(a, uniform(0.5, 1.5), uniform(0.1, 1.5)));
      case 3:
        return std::make_shared<Superellipsoid>(Vector3::Constant(a), uniform(4, 60), uniform(4, 60));
      case 4:
        return std::make_shared<Superellipsoid>(Vector3(a, a, 0.2 * a), 2, 20);
      case 5:
        return std::make_shared<Sphere>(a);
      case 6:
        return std::make_shared<Superellipsoid>(Vector3(a, a, a), 1.1, 1.1);
      case 7:
        return std::make_shared<Capsule>(0.2 * a, a);
      default:
        return std::make_shared<Ellipsoid>(Vector3(a, uniform(0.5, 1.5), uniform(0.5, 1.5)));
    }
  }

  /// The first body is near the origin. The bodies are `gap` (m) apart at time 0 along a random normal.
  MovingPair draw(const MotionKind& kind, double gap) {
    MovingPair pair;
    pair.one.shape = shape();
    pair.other.shape = shape();
    pair.unit = std::min(pair.one.shape->half_extents().minCoeff(), pair.other.shape->half_extents().minCoeff());
    pair.horizon = std::pow(10, uniform(-3, 1));
    Motion& motion1 = pair.one.motion;
    Motion& motion2 = pair.other.motion;
    motion1.pose.rotation = rotation();
    motion2.pose.rotation = rotation();
    const Vector3 n = direction();
    const Vector3 point2 = motion2.pose.rotation * pair.other.shape->point(-(motion2.pose.rotation.transpose() * n));
    motion2.pose.position = motion1.pose.rotation * pair.one.shape->point(motion1.pose.rotation.transpose() * n) + gap * n - point2;
    const double distance = motion2.pose.position.norm();
    const Vector3 common = uniform(0, 10) / pair.horizon * direction();
    // Towards the other body, up to their size.
    const Vector3 towards = (motion2.pose.position + uniform(0, 1.5) * distance * direction()).normalized();
    motion1.velocity = common + kind.speed * distance / pair.horizon * uniform(0, 1) * towards;
    motion2.velocity = common;
    for (Motion* motion : {&motion1, &motion2}) {
      motion->angular_velocity = kind.turns / pair.horizon * uniform(0, 1) * direction();
      if (kind.is_off) motion->centre = uniform(0, 1) * direction();
    }
    return pair;
  }
};

inline LongPose long_pose_at(const Motion& motion, double time) {
  const Real3 offset = motion.centre.cast<Real>(), way = Real{time} * motion.velocity.cast<Real>();
  LongPose pose{motion.pose.position.cast<Real>(), motion.pose.rotation.cast<Real>()};
  pose.position += pose.rotation * offset;  // of the centre
  pose = pose.moved(way, Real{time} * motion.angular_velocity.cast<Real>());
  pose.position -= pose.rotation * offset;
  return pose;
}

/// The gap of the pair at a time in long double, at the normal of a query from a cold start. This normal has rounding errors. The
/// gap function is stationary there and changes by their square only; on faces it changes by the rounding itself.
inline Real gap_at(const MovingPair& pair, double t) {
  const Settings settings{.tolerance = 1e-13};
  const Shape& shape1 = *pair.one.shape;
  const Shape& shape2 = *pair.other.shape;
  const Proximity proximity = find_proximity(shape1, pose_at(pair.one.motion, t), shape2, pose_at(pair.other.motion, t), settings);
  return long_gap(*long_body_of(shape1), long_pose_at(pair.one.motion, t), *long_body_of(shape2),
                  long_pose_at(pair.other.motion, t), proximity.normal.cast<Real>());
}

/// m/s; an upper bound on the rate of the gap: the speed of the centres, plus the angular velocities times the radii of the bodies.
inline double fastest(const MovingPair& pair) {
  double speed = (pair.other.motion.velocity - pair.one.motion.velocity).norm();
  for (const MovingBody* body : {&pair.one, &pair.other}) {
    speed += body->motion.angular_velocity.norm() * (body->shape->half_extents().norm() + body->motion.centre.norm());
  }
  return speed;
}

/// m; the sum of the sizes, the distance and the displacement of the bodies. The rounding error of the gap is a fraction of it.
inline double terms(const MovingPair& pair) {
  double sum = pair.other.motion.pose.position.norm() + pair.horizon * fastest(pair);
  for (const MovingBody* body : {&pair.one, &pair.other}) sum += body->shape->half_extents().norm() + body->motion.centre.norm();
  return sum;
}

/// s; the gap exceeds `level` (m) before this time. Each step is so short that the gap cannot fall by more than its excess. The
/// result is `horizon` if no gap is this small, and the time reached if `most_steps` are too few.
inline double apart_until(const MovingPair& pair, double horizon, double level, int most_steps) {
  const double speed = fastest(pair);
  double t = 0;
  for (int step = 0; step < most_steps; ++step) {
    const auto excess = static_cast<double>(gap_at(pair, t) - level);
    if (excess <= 0) return t;
    if (speed * (horizon - t) <= excess) return horizon;
    t += excess / speed;
  }
  return t;
}

/// The deepest overlap of the pair, m, at `samples` times before `until`, evenly spaced and denser near the end.
inline double deepest_before(const MovingPair& pair, double until, int samples) {
  double depth = 0;
  for (int k = 0; k < samples; ++k) {
    const double share = static_cast<double>(k) / samples;
    depth = std::max(depth, static_cast<double>(-gap_at(pair, share * until)));
    depth = std::max(depth, static_cast<double>(-gap_at(pair, (1 - std::pow(10, -8 * share)) * until)));
  }
  return depth;
}

inline Impact find_impact(const MovingPair& pair) {
  return find_time_of_impact(*pair.one.shape, pair.one.motion, *pair.other.shape, pair.other.motion, pair.horizon);
}

/// The findings of a slow search about an impact.
struct Verdict {
  double overlap_before = 0;  ///< m; the deepest overlap at the sampled times before it
  double gap = 0;             ///< m; the gap at the impact
  double earlier = 0;         ///< s; how much earlier it is than a gap of a millionth of the size
  double tolerance = 0;       ///< m; of the impact
  double rounding = 0;        ///< m; four times the rounding of s (lib/impact/README.md)

  bool is_right() const { return overlap_before <= rounding && gap <= tolerance + rounding && gap >= -rounding && earlier <= 0; }
};

/// Checks an impact, or the answer that there is none. Pairs that overlap at the start are not checked.
inline Verdict judge(const MovingPair& pair, const Impact& impact) {
  Verdict verdict;
  verdict.tolerance = 1e-9 * pair.unit;
  verdict.rounding = 64 * std::numeric_limits<double>::epsilon() * terms(pair);  // as the documented tolerance allows
  verdict.overlap_before = deepest_before(pair, impact.apart_until, 40);
  if (impact.status != ImpactStatus::Hits) return verdict;
  verdict.gap = static_cast<double>(gap_at(pair, impact.time));
  verdict.earlier = apart_until(pair, pair.horizon, 1e-6 * pair.unit, 300) * (1 - 1e-12) - impact.time;
  return verdict;
}

}  // namespace supernormal::test
