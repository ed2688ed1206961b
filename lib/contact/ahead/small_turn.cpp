#include "contact/ahead/small_turn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/ahead/meeting.hpp"
#include "contact/manifold/convex_polygon.hpp"
#include "proximity/tangent_plane.hpp"

namespace supernormal {
namespace {

// radians; by so much an impact may turn a body, and by so much more if it turns already. The corners of a manifold hold for the
// first (manifold/manifold_of_gaps.cpp). Of turns above the sum no step tells what they lead to.
constexpr double kLargestTurn = 0.1;
constexpr double kLargestTurnBefore = 0.2;

// From this multiple of the largest turn on, the lever is that of the largest turn; below it is in between, so that no force jumps.
constexpr double kFarTooLarge = 2;

// An impact that is faster than this, in smallest half-extents within the time, has one contact: quickstep's 20 iterations leave a
// share of some 1e-3 of a velocity that several contacts stop together.
constexpr double kOneContact = 100;

// A ball around the centre that is in the body, as a share of the smallest half-extent: that of an octahedron is 0.577.
constexpr double kInnerBall = 0.5;

/// The place of the contacts that is nearest to `point`, a point of their tangent plane.
Vector3 nearest_place(const ContactManifold& manifold, const Vector3& point) {
  if (manifold.corner_count == 0) return manifold.deepest.contact;
  const ContactFrame frame{TangentPlane::at(manifold.deepest.normal), point};
  ConvexPolygon region;
  for (int k = 0; k < manifold.corner_count; ++k) region.add(frame.project(manifold.corners[static_cast<std::size_t>(k)].point));
  bool is_inside = region.area() > 0;
  for (int k = 0; k < region.size(); ++k) is_inside = is_inside && cross(region[k], region[(k + 1) % region.size()]) >= 0;
  return is_inside ? point : frame.lift(region.nearest_to({0, 0}));
}

/// How far a ball in the body, around its centre, is behind the plane through `place`, m; `normal` points out of the body.
double height_of(const BodyAhead& body, const Vector3& normal, const Vector3& place) {
  return normal.dot(place - body.motion.centre) - kInnerBall * body.shape.half_extents().minCoeff();
}

/// How far from the line through the centres a contact may act that stops two bodies.
struct LeverLimit {
  const BodyAhead& body1;
  const BodyAhead& body2;
  double share;     // of body 1 in the motion of both
  Vector3 normal;   // unit, from body 1 to body 2
  double approach;  // m; how much nearer the centres would come than the contacts let the bodies
  double turn;      // radians; in which the bodies are already
  double height;    // m; by so much the centres may come nearer at any attitude

  /// The squared radius of gyration about the axis of the turn by a force with this lever, m^2.
  double squared_gyration(const Vector3& lever) const {
    const Vector3 torque = lever.cross(normal);
    const double turning = torque.dot((share * body1.motion.turning + (1 - share) * body2.motion.turning) * torque);
    return turning > 0 ? lever.squaredNorm() / turning : 0;
  }

  /// The largest part of a lever with which the impact turns the bodies by no more than the largest turn.
  double part_for_small_turn(const Vector3& arm) const {
    const double lever = arm.norm();
    const double gyration = squared_gyration(arm);
    const double largest = kLargestTurn + std::min(kLargestTurnBefore, turn);
    const double excess = lever > 0 ? approach * lever / (lever * lever + gyration) / largest : 0;
    if (!(excess > 1)) return 1;
    const double twice = 2 * largest * std::sqrt(gyration);
    const double root = std::sqrt(std::max(0.0, approach * approach - twice * twice));
    const double small = std::min(lever, 2 * largest * gyration / (approach + root));
    return 1 - std::min(1.0, (excess - 1) / (kFarTooLarge - 1)) * (1 - small / lever);
  }

  /// The largest part of a lever with which a contact lets the centres come nearer by no more than the height, by the impact and by
  /// the turn in which the bodies are: (A b^2 + u b k^2) / (b^2 + k^2) <= H for the approach A, the turn u and the lever b.
  double part_for_height(const Vector3& arm) const {
    const double lever = arm.norm();
    const double gyration = squared_gyration(arm);
    const double of_turn = turn * gyration;
    const double discriminant = of_turn * of_turn + 4 * (approach - height) * height * gyration;
    if (!(discriminant >= 0)) return 1;
    const double allowed = 2 * height * gyration;
    const double asked = lever * (of_turn + std::sqrt(discriminant));
    return allowed < asked ? allowed / asked : 1;
  }
};

}  // namespace

void limit_turn(const BodyAhead& body1, const BodyAhead& body2, double time, double share, ContactManifold& manifold) {
  const Vector3& normal = manifold.deepest.normal;
  const double closing = normal.dot(body1.motion.velocity - body2.motion.velocity);
  const double gained = time * std::max(body1.motion.acceleration, body2.motion.acceleration);
  const double approach = (closing + gained) * time - manifold.deepest.gap;
  if (!(approach > 0)) return;
  const Vector3 centre = share * body1.motion.centre + (1 - share) * body2.motion.centre;
  const auto arm_of = [&](const Vector3& place) {
    const Vector3 way = place - centre;
    return Vector3(way - normal.dot(way) * normal);
  };
  const Vector3& contact = manifold.deepest.contact;
  const double height = share * height_of(body1, normal, contact) + (1 - share) * height_of(body2, -normal, contact) +
                        std::min(0.0, manifold.deepest.gap);
  const double turn = time * (share * body1.motion.turn_rate + (1 - share) * body2.motion.turn_rate);
  const LeverLimit limit{body1, body2, share, normal, approach, turn, std::max(0.0, height)};
  const Vector3 place = nearest_place(manifold, contact - arm_of(contact));
  const Vector3 arm = arm_of(place);
  const auto cut_from = [&](const Vector3& lever) {
    return Vector3((std::min(limit.part_for_small_turn(lever), limit.part_for_height(lever)) - 1) * lever);
  };
  const Vector3 shift = cut_from(arm);
  for (ManifoldCorner& corner : manifold.corners) corner.point += shift;
  manifold.deepest.contact += cut_from(arm_of(contact));  // with room for one it acts alone
  if (approach > kOneContact * smaller_thickness(body1.shape, body2.shape)) {
    manifold.deepest.contact = place + shift;
    manifold.corner_count = 0;
  }
}

}  // namespace supernormal
