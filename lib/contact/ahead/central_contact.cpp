#include "contact/ahead/central_contact.hpp"

#include <algorithm>

namespace supernormal {
namespace {

// radians; the turn by which the corners of a manifold are known to hold (manifold/manifold_of_gaps.cpp).
constexpr double kLargestTurn = 0.1;

// A ball around the centre that is in the body, as a share of the smallest half-extent: that of an octahedron is 0.577.
constexpr double kInnerBall = 0.5;

/// The middle of the contacts, with their mean depth.
ManifoldCorner middle_of(const ContactManifold& manifold) {
  if (manifold.corner_count == 0) return {manifold.deepest.contact, -manifold.deepest.gap};
  ManifoldCorner middle;
  for (int k = 0; k < manifold.corner_count; ++k) {
    const ManifoldCorner& corner = manifold.corners[static_cast<std::size_t>(k)];
    middle.point += corner.point / manifold.corner_count;
    middle.depth += corner.depth / manifold.corner_count;
  }
  return middle;
}

/// How far the body's inner ball is behind the plane through `point`, m; `normal` points out of the body.
double height_of(const MovingBody& body, const Vector3& normal, const Vector3& point) {
  return normal.dot(point - body.motion.centre) - kInnerBall * body.shape.half_extents().minCoeff();
}

}  // namespace

void hold_centre(const MovingBody& body1, const MovingBody& body2, double time, double share, ContactManifold& manifold) {
  const Vector3& normal = manifold.deepest.normal;
  const double closing = normal.dot(body1.motion.velocity - body2.motion.velocity) * time;
  const ManifoldCorner middle = middle_of(manifold);
  if (closing <= -middle.depth) return;
  const Vector3 centre = share * body1.motion.centre + (1 - share) * body2.motion.centre;
  const Vector3 above = centre + normal.dot(middle.point - centre) * normal;
  const double lever = (middle.point - above).norm();
  const double turn = kLargestTurn + time * (share * body1.motion.turn_rate + (1 - share) * body2.motion.turn_rate);
  const double height = share * height_of(body1, normal, middle.point) + (1 - share) * height_of(body2, -normal, middle.point);
  const double gap = std::min(turn * lever, std::max(0.0, height)) - middle.depth;
  if (closing <= gap) return;
  manifold.has_centre = true;
  manifold.centre = {above, -gap};
}

}  // namespace supernormal
