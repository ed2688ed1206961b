// The manifold of bodies that are apart, touch or overlap slightly, with the gap of each manifold point.
#include <algorithm>
#include <optional>

#include "contact/manifold/common_corners.hpp"
#include "contact/manifold/corner_depth.hpp"
#include "contact/manifold/support_polygon.hpp"
#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal {
namespace {

// A point this fraction of same_place above the other one has the least weight when the two are merged.
constexpr double kShallow = 0.1;

bool may_stand(const Shape& shape, const Proximity& proximity) {
  return proximity.status != Status::InvalidInput && may_have_corners(shape);
}

/// Sets the distances within which manifold points are merged.
void set_distances(double size, ContactManifold& manifold) {
  manifold.same_place = kSamePlace * size;
  manifold.shallow = kShallow * manifold.same_place;
}

}  // namespace

ContactManifold find_manifold_of_gaps(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                      const Proximity& proximity, double share, double tilt) {
  ContactManifold manifold(proximity);
  manifold.deepest.contact += (0.5 - share) * proximity.gap * proximity.normal;
  if (!may_stand(shape1, proximity) || !may_stand(shape2, proximity)) return manifold;
  const SupportPolygon polygon1 = SupportPolygon::of_tilt(shape1, pose1, proximity.normal, proximity.point1, tilt);
  manifold.evaluations = polygon1.evaluations();
  if (!polygon1.has_width()) return manifold;
  const SupportPolygon polygon2 = SupportPolygon::of_tilt(shape2, pose2, -proximity.normal, proximity.point2, tilt);
  manifold.evaluations += polygon2.evaluations();
  if (!polygon2.has_width()) return manifold;
  const std::optional<CornerList> corners = find_common_corners(polygon1, polygon2, proximity.normal, manifold.deepest.contact);
  if (!corners) return manifold;
  write_gaps(*corners, proximity.gap, manifold);
  set_distances(std::min(polygon1.size(), polygon2.size()), manifold);
  return manifold;
}

ContactManifold find_plane_manifold_of_gaps(const Shape& shape, const Pose& pose, const Proximity& proximity, double tilt) {
  ContactManifold manifold(proximity);
  if (!may_stand(shape, proximity)) return manifold;
  const Vector3 support_point = pose.rotation * shape.point(pose.rotation.transpose() * proximity.normal) + pose.position;
  const SupportPolygon polygon = SupportPolygon::of_tilt(shape, pose, proximity.normal, support_point, tilt);
  manifold.evaluations = 1 + polygon.evaluations();
  if (!polygon.has_width()) return manifold;
  // At the border of a sheet the contact may be beside the point on which the body would stand if the sheet continued.
  const double below = std::max(0.0, proximity.normal.dot(support_point - proximity.point1));
  write_gaps(corners_over_plane(polygon, proximity.normal), proximity.gap - below, manifold);
  set_distances(polygon.size(), manifold);
  return manifold;
}

}  // namespace supernormal
