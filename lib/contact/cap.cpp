#include "contact/cap.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

// Of the body's extent along a direction: how exactly the corners of a cap are found.
constexpr double kReachTolerance = 0.01;

// Two or three suffice for most; the chords halve what is left at worst.
constexpr int kMaxEvaluations = 24;

// A search for depth T aims at this share of it: just inside, where the tangent tells that it is near.
constexpr double kAim = 0.95;

// The first guess of the slope where a cap ends, in units of depth over extent.
constexpr double kFirstSteepness = 12;

// Of the extent: farther beyond its corners no cap bulges that is as good as a rectangle.
constexpr double kBulge = 0.15;

// Where the drop tells nothing about the slope: times the last.
constexpr double kSteeper = 4;

// Of the depth: a lesser drop says nothing about the shape, and its powers overflow.
constexpr double kLeastDrop = 1e-30;

// As a slope this is sideways: beyond it the cap is the whole body.
constexpr double kSteepest = 1e6;

// Of the extent of the body: of deeper caps no single tangent plane tells much.
constexpr double kMostShallow = 0.5;

// Of the extent of the body: no cap at rest is wider if the body is round (README, "Resting").
constexpr double kWide = 0.25;

/// A boundary point as seen from the side: on the curve of points with normals between n and u.
struct ProfilePoint {
  Vector3 point = Vector3::Zero();
  double x = 0;      ///< m; along u
  double drop = 0;   ///< m; below the tangent plane with normal n
  double slope = 0;  ///< of the curve there
};

/// The shadow of a body on the plane of n and u, between its highest point and where it reaches farthest along u: a convex
/// curve, drop over x. Finds where it is `depth` below.
class Profile {
 public:
  Profile(const ProfilePoint& highest, double depth, double extent, double first_slope)
      : start_(highest), inner_(highest), depth_(depth), extent_(extent), first_slope_(first_slope) {}

  double next_slope() const {
    if (!has_last_) return first_slope_;
    // As if the drop were a power of x; from a single point, since the exponent is x slope / drop.
    const double exponent = last_.drop > kLeastDrop * depth_ ? (last_.x - start_.x) * last_.slope / last_.drop : 0;
    const double by_power = exponent > 1 ? last_.slope * std::pow(kAim * depth_ / last_.drop, 1 - 1 / exponent) : 0;
    if (!has_outer_) return std::max(by_power, kSteeper * inner_.slope);
    const bool is_between = by_power > inner_.slope && by_power < outer_.slope;
    // The slope of the chord has its point between the two, and as far from the chord as there is any.
    return is_between && uses_power_ ? by_power : (outer_.drop - inner_.drop) / (outer_.x - inner_.x);
  }

  void add(const ProfilePoint& point) {
    uses_power_ = !uses_power_ || !has_outer_;
    last_ = point;
    has_last_ = true;
    if (point.drop <= depth_) {
      inner_ = point;
    } else {
      outer_ = point;
      has_outer_ = true;
    }
  }

  bool is_found() const {
    if (has_outer_ && !(outer_.x > inner_.x && outer_.slope > inner_.slope)) return true;
    return farthest_possible() - x_inside() <= kReachTolerance * extent_;
  }

  /// Where the cap ends, or a little before.
  double slope() const { return inner_.slope; }

  /// On the chord, and so in the body.
  Vector3 point() const {
    if (!has_outer_) return inner_.point;
    return inner_.point + (outer_.point - inner_.point) * share();
  }

 private:
  double share() const { return (depth_ - inner_.drop) / (outer_.drop - inner_.drop); }
  double x_inside() const { return has_outer_ ? inner_.x + (outer_.x - inner_.x) * share() : inner_.x; }

  // By the tangents, which the curve is below.
  double farthest_possible() const {
    const double by_inner = inner_.slope > 0 ? inner_.x + (depth_ - inner_.drop) / inner_.slope : HUGE_VAL;
    const double by_outer = has_outer_ ? outer_.x - (outer_.drop - depth_) / outer_.slope : HUGE_VAL;
    return std::min(by_inner, by_outer);
  }

  ProfilePoint start_;
  ProfilePoint inner_;  // the last that is within the depth
  ProfilePoint outer_;
  ProfilePoint last_;
  double depth_;
  double extent_;
  double first_slope_;
  bool has_outer_ = false;
  bool has_last_ = false;
  bool uses_power_ = true;
};

std::array<Vector3, 2> tangent_axes(const Matrix3& rotation, const Vector3& n) {
  int flattest = 0;
  (rotation.transpose() * n).cwiseAbs().minCoeff(&flattest);
  const TangentPlane plane(n, rotation.col(flattest));
  return {plane.t1, plane.t2};
}

}  // namespace

Cap::Cap(const Shape& shape, const Pose& pose, const Vector3& n, double depth)
    : shape_(&shape),
      pose_(pose),
      n_(n),
      depth_(depth),
      half_extents_(shape.half_extents()),
      axes_(tangent_axes(pose.rotation, n)),
      steepness_(kFirstSteepness) {
  shape.evaluate(pose.rotation.transpose() * n, Order::Point, highest_);
}

// Of the ellipsoid with the body's half-extents.
double Cap::extent(const Vector3& direction) const {
  return (pose_.rotation.transpose() * direction).cwiseProduct(half_extents_).norm();
}

double Cap::wide_from(const Vector3& direction, double share) const {
  const double relative_depth = std::min(1.0, depth_ / extent(n_));
  return 2 * (share + std::sqrt(relative_depth * (2 - relative_depth))) * extent(direction);
}

Vector3 Cap::farthest(const Vector3& direction) {
  const Vector3 n = pose_.rotation.transpose() * n_;
  const Vector3 u = pose_.rotation.transpose() * direction;
  const double reach = extent(direction);
  // The last direction's end is a good guess for the next one's.
  Profile profile({highest_.r, u.dot(highest_.r), 0, 0}, depth_, reach, steepness_ * depth_ / reach);
  Jet jet;
  for (int k = 0; k < kMaxEvaluations && !profile.is_found(); ++k) {
    const double slope = profile.next_slope();
    if (!(slope < kSteepest)) break;
    shape_->evaluate((n + slope * u) / std::sqrt(1 + slope * slope), Order::Point, jet);
    ++evaluations_;
    profile.add({jet.r, u.dot(jet.r), std::max(0.0, n.dot(highest_.r - jet.r)), slope});
  }
  if (profile.slope() > 0) steepness_ = profile.slope() * reach / depth_;
  return pose_.position + pose_.rotation * profile.point();
}

double Cap::width(const Vector3& direction) const {
  const auto [low, high] = std::minmax_element(corners_.begin(), corners_.end(), [&](const Vector3& one, const Vector3& other) {
    return direction.dot(one) < direction.dot(other);
  });
  return direction.dot(*high - *low);
}

// A tangent plane bounds the cap. The best one for an ellipsoid with the body's half-extents tells most bodies that are not flat
// there.
double Cap::bound_along(const Vector3& direction) {
  const double relative_depth = depth_ / extent(n_);
  const double slope = extent(n_) / extent(direction) * std::sqrt(relative_depth * (2 - relative_depth)) / (1 - relative_depth);
  const Vector3 n = pose_.rotation.transpose() * n_;
  const Vector3 u = pose_.rotation.transpose() * direction;
  Jet jet;
  shape_->evaluate((n + slope * u) / std::sqrt(1 + slope * slope), Order::Point, jet);
  ++evaluations_;
  const Vector3 way = jet.r - highest_.r;
  return u.dot(way) + (depth_ + n.dot(way)) / slope;
}

bool Cap::is_surely_narrow() {
  if (depth_ > kMostShallow * extent(n_)) return false;
  return std::all_of(axes_.begin(), axes_.end(),
                     [&](const Vector3& axis) { return bound_along(axis) + bound_along(-axis) <= wide_from(axis, kWide); });
}

bool Cap::is_narrow() {
  const Vector3 a = extent(axes_[0]) * axes_[0];
  const Vector3 b = extent(axes_[1]) * axes_[1];
  corners_ = {farthest((a + b).normalized()), farthest((b - a).normalized()), farthest((-a - b).normalized()),
              farthest((a - b).normalized())};
  return !(width(axes_[0]) > wide_from(axes_[0], kWide)) && !(width(axes_[1]) > wide_from(axes_[1], kWide));
}

Footprint Cap::footprint(const PatchFrame& frame) {
  std::array<Vector3, 8> corners;
  std::size_t count = 0;
  const Vector3 ahead = farthest(axes_[0]);
  const bool is_box_like = axes_[0].dot(ahead - corners_[0]) < kBulge * extent(axes_[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    // Counter-clockwise about n: the axis before the diagonal.
    if (!is_box_like) corners[count++] = k == 0 ? ahead : farthest(k < 2 ? axes_[k] : Vector3(-axes_[k - 2]));
    corners[count++] = corners_[k];
  }
  // The frame may see them from the other side.
  if (frame.plane.n.dot(n_) < 0) std::reverse(corners.begin(), corners.begin() + count);
  Footprint footprint;
  for (std::size_t k = 0; k < count; ++k) footprint.add(frame.project(corners[k]));
  return footprint;
}

}  // namespace supernormal
