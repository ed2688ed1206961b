#include "contact/cap.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

// Of the body's extent along a direction: how exactly the corners of a cap are found.
constexpr double kReachTolerance = 0.02;

// Two or three suffice for most; the chords halve what is left at worst.
constexpr int kMaxEvaluations = 24;

// A search for depth T aims at this share of it: just inside, where the tangent tells that it is near.
constexpr double kAim = 0.95;

// The first guess of the slope where a cap ends, in units of depth over extent: right for exponents about 5.
constexpr double kFirstSlope = 8;

// Where the drop tells nothing about the slope: times the last.
constexpr double kSteeper = 4;

// As a slope this is sideways: beyond it the cap is the whole body.
constexpr double kSteepest = 1e6;

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
  Profile(const ProfilePoint& highest, double depth, double extent)
      : start_(highest), inner_(highest), depth_(depth), extent_(extent) {}

  double next_slope() const {
    if (!has_last_) return kFirstSlope * depth_ / extent_;
    // As if the drop were a power of x; from a single point, since the exponent is x slope / drop.
    const double exponent = last_.drop > 0 ? (last_.x - start_.x) * last_.slope / last_.drop : 0;
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
      axes_(tangent_axes(pose.rotation, n)) {
  shape.evaluate(pose.rotation.transpose() * n, Order::Point, highest_);
}

// Of the ellipsoid with the body's half-extents.
double Cap::extent(const Vector3& direction) const {
  return (pose_.rotation.transpose() * direction).cwiseProduct(half_extents_).norm();
}

double Cap::wide_from(const Vector3& direction) const {
  const double relative_depth = std::min(1.0, depth_ / extent(n_));
  return 2 * (kWide + std::sqrt(relative_depth * (2 - relative_depth))) * extent(direction);
}

Vector3 Cap::farthest(const Vector3& direction) {
  const Vector3 n = pose_.rotation.transpose() * n_;
  const Vector3 u = pose_.rotation.transpose() * direction;
  Profile profile({highest_.r, u.dot(highest_.r), 0, 0}, depth_, extent(direction));
  Jet jet;
  for (int k = 0; k < kMaxEvaluations && !profile.is_found(); ++k) {
    const double slope = profile.next_slope();
    if (!(slope < kSteepest)) break;
    shape_->evaluate((n + slope * u) / std::sqrt(1 + slope * slope), Order::Point, jet);
    ++evaluations_;
    profile.add({jet.r, u.dot(jet.r), std::max(0.0, n.dot(highest_.r - jet.r)), slope});
  }
  return pose_.position + pose_.rotation * profile.point();
}

bool Cap::is_narrow() {
  bool narrow = true;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    along_axes_[axis] = farthest(axes_[axis]);
    along_axes_[axis + 2] = farthest(-axes_[axis]);
    narrow = narrow && !(axes_[axis].dot(along_axes_[axis] - along_axes_[axis + 2]) > wide_from(axes_[axis]));
  }
  return narrow;
}

Footprint Cap::footprint(const PatchFrame& frame) {
  const double a = extent(axes_[0]);
  const double b = extent(axes_[1]);
  const std::array<Vector3, 4> diagonals = {a * axes_[0] + b * axes_[1], b * axes_[1] - a * axes_[0], -a * axes_[0] - b * axes_[1],
                                            a * axes_[0] - b * axes_[1]};
  std::array<Vector2, 8> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[2 * k] = frame.project(along_axes_[k]);
    corners[2 * k + 1] = frame.project(farthest(diagonals[k].normalized()));
  }
  // Counter-clockwise about n; the frame may see them from the other side.
  if (frame.plane.n.dot(n_) < 0) std::reverse(corners.begin(), corners.end());
  Footprint footprint;
  for (const Vector2& corner : corners) footprint.add(corner);
  return footprint;
}

}  // namespace supernormal
