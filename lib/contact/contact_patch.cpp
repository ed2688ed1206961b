#include "supernormal/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "contact/cap.hpp"
#include "shapes/validation.hpp"

namespace supernormal {
namespace {

// The corners are found for a depth that is larger than the real one by this many times, but not by more than this share of the
// body's smallest half-extent. With 0, the edge of the overlap itself, a body with exponent 8 takes 2.3 times as long to come to
// rest as a box; with these 1.5 times (medians of 24 drops).
constexpr double kMargin = 5;
constexpr double kLargestMargin = 0.2;

// Of the bodies: what two flat faces have in common can be less than either and still be something to stand on.
constexpr double kWideOverlap = 0.125;

// Of the smallest half-extent: a lesser depth is rounding.
constexpr double kLeastDepth = 1e-12;

// Not a plate or a segment, which has no thickness to be deep in; nor anything else that is thinner than a body of ours may be.
bool may_have_corners(const Shape& shape, const Proximity& proximity) {
  const bool is_answer = proximity.status != Status::InvalidInput && proximity.status != Status::Apart;
  const double thickness = shape.half_extents().minCoeff();
  return is_answer && !shape.is_round() && thickness >= kMinLength && -proximity.gap > kLeastDepth * thickness;
}

double margin_of(const Shape& shape, const Proximity& proximity) {
  return std::min(-kMargin * proximity.gap, kLargestMargin * shape.half_extents().minCoeff());
}

/// The region of the overlap, and the caps of the bodies, which know what is wide.
class Region {
 public:
  Region(const Footprint& footprint, std::span<Cap*> caps) : footprint_(footprint), caps_(caps) {}

  /// Those corners, in coordinates about the contact point, that deserve a contact.
  Footprint corners(const TangentPlane& plane) const {
    if (footprint_.size() == 0) return {};
    Vector2 narrowest = Vector2::UnitX();
    double least = width_over_wide(plane, narrowest);
    for (const Cap* cap : caps_) {
      for (const Vector3& axis : cap->axes()) {
        const double width = width_over_wide(plane, plane.project(axis));
        if (width >= least) continue;
        least = width;
        narrowest = plane.project(axis);
      }
    }
    if (least > 1) return footprint_.quadrangle();
    const Vector2 across(-narrowest.y(), narrowest.x());
    if (!(width_over_wide(plane, across) > 1)) return {};
    // Long and narrow: both ends of the line through the contact point, on which the body can roll.
    const Footprint::Range range = footprint_.range(across);
    Footprint ends;
    ends.add(range.low * across);
    ends.add(range.high * across);
    return ends;
  }

 private:
  double width_over_wide(const TangentPlane& plane, const Vector2& direction) const {
    double wide = HUGE_VAL;
    for (const Cap* cap : caps_) wide = std::min(wide, cap->wide_from(plane.lift(direction), kWideOverlap));
    return footprint_.range(direction).width() / wide;
  }

  Footprint footprint_;
  std::span<Cap*> caps_;
};

void add_corners(const Footprint& corners, const PatchFrame& frame, ContactPatch& patch) {
  patch.corner_count = corners.size();
  for (int k = 0; k < corners.size(); ++k) patch.corners[static_cast<std::size_t>(k)] = frame.origin + frame.plane.lift(corners[k]);
}

}  // namespace

ContactPatch find_contact_patch(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                const Proximity& proximity) {
  ContactPatch patch(proximity);
  if (!may_have_corners(shape1, proximity) || !may_have_corners(shape2, proximity)) return patch;
  const double depth = -proximity.gap;
  const double margin1 = margin_of(shape1, proximity);
  const double margin2 = margin_of(shape2, proximity);
  patch.margin = depth + margin1 + margin2;
  Cap cap1(shape1, pose1, proximity.normal, depth + margin1);
  Cap cap2(shape2, pose2, -proximity.normal, depth + margin2);
  // The smaller body first: it is more often the round one, and the order of the arguments does not matter then.
  std::array<Cap*, 2> caps = {&cap1, &cap2};
  if (cap2.shadow() < cap1.shadow()) std::swap(caps[0], caps[1]);
  // A round body has one contact, also with a small flat one, as dSphere has.
  const bool is_round = caps[0]->is_surely_narrow() || caps[1]->is_surely_narrow();
  if (!is_round && !caps[0]->is_narrow() && !caps[1]->is_narrow()) {
    const PatchFrame frame{TangentPlane(caps[0]->normal(), caps[0]->axes()[0]), proximity.contact};
    const Footprint overlap = caps[0]->footprint(frame).intersected(caps[1]->footprint(frame));
    add_corners(Region(overlap, caps).corners(frame.plane), frame, patch);
  }
  patch.evaluations = cap1.evaluations() + cap2.evaluations();
  return patch;
}

ContactPatch find_plane_contact_patch(const Shape& shape, const Pose& pose, const Proximity& proximity) {
  ContactPatch patch(proximity);
  if (!may_have_corners(shape, proximity)) return patch;
  patch.margin = margin_of(shape, proximity);
  Cap cap(shape, pose, proximity.normal, patch.margin - proximity.gap);
  std::array<Cap*, 1> caps = {&cap};
  if (!cap.is_surely_narrow() && !cap.is_narrow()) {
    const PatchFrame frame{TangentPlane(proximity.normal, cap.axes()[0]), proximity.point2};
    add_corners(Region(cap.footprint(frame), caps).corners(frame.plane), frame, patch);
  }
  patch.evaluations = cap.evaluations();
  return patch;
}

}  // namespace supernormal
