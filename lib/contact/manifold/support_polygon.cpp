#include "contact/manifold/support_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/tangent_plane.hpp"
#include "contact/manifold/convex_polygon.hpp"
#include "shapes/lanes/four_normals.hpp"
#include "shapes/lanes/lane_body_of.hpp"

namespace supernormal {
namespace {

// The reach: the bodies may be this far apart at a vertex. The first term is in least extents, at any depth. The least extent is
// the smallest of the half-height, both half-extents in the plane and the thickness of the other body. So the polygon does not
// shrink to a point when quickstep takes the depth away. The second term is in depths, for bodies that fall. With a smaller one,
// bodies with round edges take longer to rest than a dBox.
constexpr double kReach = 2e-3;
constexpr double kReachOfDepth = 12;

// Largest reach, in least extents, but at least the depth. With a larger reach the vertices would support a tilted falling body in
// the air.
constexpr double kLargestReach = 0.07;

// A face like |x|^e with this exponent has its vertices exactly at the reach. The vertices of a flatter face are nearer to its end.
constexpr double kFaceExponent = 8;

// Largest tilt, half-heights over half-extents. With a larger tilt the vertices would be on the sides of the body.
constexpr double kLargestTilt = 1;

// At a larger tilt than this, a flat body with round ends looks round. So the widths are taken at this tilt, too. A capsule of
// half-length 0.3 radii is still flat at it.
constexpr double kNear = 0.3;

// Exponents of faces like |x|^e: the body is round up to the first, and flat from the second on. The closed forms of rocking bodies
// hold up to exponent 4. The fraction of this exponent is up to 4 % less than 1/4 at the tilts below. Bodies come to rest with the
// second exponent.
constexpr double kRoundExponent = 4.5;
constexpr double kFlatExponent = 6;

// In half-extents; two ends nearer to each other than this differ by rounding. The body then ends in an edge or a vertex.
constexpr double kLeastLength = 1e-6;

// A polygon is long from this ratio of its sides on. Any ratio well above 1 does: a square polygon has no axis to tell from.
constexpr double kLong = 2;

using Tilt = std::array<double, 2>;  // of the normal, n + tilt[0] axes[0] + tilt[1] axes[1]

/// A number of each of four tilts.
using Four = Eigen::Array4d;
using FourTilts = std::array<Four, 2>;

// The four tilts along the axes, and the four along the diagonals, counter-clockwise.
FourTilts along_axes(const Tilt& largest) { return {largest[0] * Four(1, -1, 0, 0), largest[1] * Four(0, 0, 1, -1)}; }
FourTilts along_diagonals(const Tilt& largest) { return {largest[0] * Four(1, -1, -1, 1), largest[1] * Four(1, 1, -1, -1)}; }

/// The ramp is 0 up to `zero` and 1 from `one` on. Either may be the larger one. Callers pass constants, so the compiler computes
/// the quotient.
inline double ramp(double value, double zero, double one) { return std::clamp((value - zero) * (1 / (one - zero)), 0.0, 1.0); }

/// The axes of a body projected into the tangent plane: two perpendicular directions. Each axis of the body is near one of them or
/// its opposite. The axes are added as complex numbers to the fourth power, where all of these directions are equal. So the result
/// is continuous in the normal. The exceptions are the normals at which the three axes look alike, towards the vertices of a box.
/// Everything is in the body's frame.
std::array<Vector3, 2> axes_in_plane(const Vector3& n) {
  int along_normal = 0;
  n.cwiseAbs().maxCoeff(&along_normal);
  const TangentPlane plane(n, Vector3::Unit((along_normal + 1) % 3));
  Vector2 sum = Vector2::Zero();
  for (int axis = 0; axis < 3; ++axis) sum += fourth_power({plane.t1[axis], plane.t2[axis]});
  if (!(sum.squaredNorm() > 0)) return {plane.t1, plane.t2};
  const Vector2 first = direction_of_fourth_power(sum);
  return {plane.lift(first), plane.lift({-first.y(), first.x()})};
}

// (kFaceExponent reach / (2 height))^(1 - 1 / kFaceExponent): the slope at which a face of this exponent has the separation reach /
// 2 along either axis, in half-heights over half-extents.
double tangent_of_tilt(double reach, double height) {
  const double x = 0.5 * kFaceExponent * reach / height;
  return std::min(kLargestTilt, std::sqrt(x * std::sqrt(x * std::sqrt(x))));
}

}  // namespace

/// A body and its tangent plane in the body's frame.
struct SupportPolygon::View {
  const Shape& shape;
  const Pose& pose;
  Vector3 half_extents;  // m
  Matrix3 to_body;
  Vector3 normal;
  Vector3 support_point;        // m
  Vector3 support_point_there;  // m; in the frame that the pose refers to
  std::array<Vector3, 2> axes;
  double rolling_radius;  // m; 0 if the ball takes nothing

  View(const Shape& body, const Pose& pose_of_body, const Vector3& n, const Vector3& point, bool without_ball)
      : shape(body),
        pose(pose_of_body),
        half_extents(body.half_extents()),
        to_body(pose.rotation.transpose()),
        normal(to_body * n),
        support_point(to_body * (point - pose.position)),
        support_point_there(point),
        axes(axes_in_plane(normal)),
        rolling_radius(without_ball ? shape.rolling_radius() : 0) {}
};

/// The points of a body whose normals are tilted against n by the same angle, in units of the half-extents.
class SupportPolygon::Tilts {
 public:
  /// Points of the body, relative to the support point.
  template <typename Number>
  struct Points {
    std::array<Number, 2> along;  ///< m; along the axes
    Number separation;            ///< m; from the tangent plane
  };
  using SupportPoint = Points<double>;
  using SupportPoints = Points<Four>;

  Tilts(const View& view, double height, const std::array<double, 2>& extents, const std::array<double, 2>& tangents)
      : view_(view),
        rolling_radius_(view.rolling_radius),
        extents_(extents),
        largest_({tangents[0] * height / extents[0], tangents[1] * height / extents[1]}),
        ends_of_body_(points_of(along_axes(largest_))),
        ends_(without_ball(ends_of_body_, along_axes(largest_))),
        lengths_({ends_.along[0][0] - ends_.along[0][1], ends_.along[1][2] - ends_.along[1][3]}) {}

  /// The points of the four tilts along the axes.
  const SupportPoints& ends() const { return ends_; }

  /// The points of the four diagonals.
  SupportPoints diagonals() const {
    const FourTilts tilts = along_diagonals(largest_);
    return without_ball(points_of(tilts), tilts);
  }

  /// The slope of the line through both ends of each axis; 0 if they coincide.
  Tilt slope() const {
    const Four& above = ends_.separation;
    const std::array<double, 2> rise = {above[0] - above[1], above[2] - above[3]};
    Tilt slope{};
    for (std::size_t a = 0; a < 2; ++a) {
      if (has_length(a)) slope[a] = std::clamp(rise[a] / lengths_[a], -largest_[a], largest_[a]);
    }
    return slope;
  }

  /// The fraction D / (D + R) along both axes, for the tangent plane with this slope, which touches the body in `from`. D and R are
  /// the separations from this plane and from the tilted planes. The fraction is 1 along an axis along which the body ends in a
  /// point.
  std::array<double, 2> fractions(const Tilt& slope, const SupportPoint& from) const {
    const FourTilts tilts = along_axes(largest_);
    Four above = ends_of_body_.separation - from.separation, sum = Four::Zero();
    for (std::size_t a = 0; a < 2; ++a) {
      const Four along = ends_of_body_.along[a] - from.along[a];
      above -= slope[a] * along;
      sum += (tilts[a] - slope[a]) * along;
    }
    above = above.min(sum).max(0);
    const Four of_tilted = (sum - above) * tilted(slope).cwiseProduct(view_.half_extents).norm() / sizes_of(tilts);
    const std::array<double, 2> separation = {above[0] + above[1], above[2] + above[3]};
    const std::array<double, 2> of_both = {separation[0] + (of_tilted[0] + of_tilted[1]),
                                           separation[1] + (of_tilted[2] + of_tilted[3])};
    std::array<double, 2> fractions = {1, 1};
    for (std::size_t a = 0; a < 2; ++a) {
      if (has_length(a)) fractions[a] = of_both[a] > 0 ? separation[a] / of_both[a] : 0;
    }
    return fractions;
  }

  /// Whether the points are those without the ball.
  bool has_ball() const { return rolling_radius_ > 0; }

  SupportPoint point_of(const Tilt& tilt) const {
    const Vector3 offset = view_.shape.point(tilted(tilt).normalized()) - view_.support_point;
    return {{view_.axes[0].dot(offset), view_.axes[1].dot(offset)}, std::max(0.0, -view_.normal.dot(offset))};
  }

 private:
  using FourVectors = Eigen::Array<double, 4, 3>;

  bool has_length(std::size_t axis) const { return lengths_[axis] > kLeastLength * extents_[axis]; }

  /// Normals of any length.
  Vector3 tilted(const Tilt& tilt) const { return view_.normal + tilt[0] * view_.axes[0] + tilt[1] * view_.axes[1]; }
  FourVectors tilted(const FourTilts& tilts) const {
    FourVectors normals;
    for (int i = 0; i < 3; ++i) normals.col(i) = view_.normal[i] + tilts[0] * view_.axes[0][i] + tilts[1] * view_.axes[1][i];
    return normals;
  }

  /// The support function of the ellipsoid with the body's half-extents. In these units its fraction is 1/2 at every tilt.
  Four sizes_of(const FourTilts& tilts) const {
    const FourVectors scaled = tilted(tilts).rowwise() * view_.half_extents.transpose().array();
    return (scaled.col(0).square() + scaled.col(1).square() + scaled.col(2).square()).sqrt();
  }

  /// A body in which a ball can roll is the sum of the ball and another body. The faces and edges of the sum end where the faces
  /// and edges of the other body end. So the body stands on the points of the other body, moved by the ball's point of the normal
  /// n.
  SupportPoints without_ball(SupportPoints points, const FourTilts& tilts) const {
    if (rolling_radius_ == 0) return points;
    const Four of_ball = rolling_radius_ / (1 + tilts[0].square() + tilts[1].square()).sqrt();
    for (std::size_t a = 0; a < 2; ++a) points.along[a] -= of_ball * tilts[a];
    points.separation = (points.separation - (rolling_radius_ - of_ball)).max(0);
    return points;
  }

  SupportPoints points_of(const FourTilts& tilts) const {
    const FourVectors normals = tilted(tilts);
    FourVectors offsets;
    if (const LaneBody* const body = LaneBodies::of(view_.shape)) {
      Four h;
      four_at_once()(*body, normals.data(), h.data(), offsets.data());
    } else {
      for (int k = 0; k < 4; ++k) {
        offsets.row(k) = view_.shape.point(normals.row(k).transpose().matrix().normalized()).transpose().array();
      }
    }
    offsets.rowwise() -= view_.support_point.transpose().array();
    const auto along = [&offsets](const Vector3& u) -> Four {
      return u[0] * offsets.col(0) + u[1] * offsets.col(1) + u[2] * offsets.col(2);
    };
    return {{along(view_.axes[0]), along(view_.axes[1])}, (-along(view_.normal)).max(0)};
  }

  const View& view_;
  double rolling_radius_;
  std::array<double, 2> extents_;
  Tilt largest_;
  SupportPoints ends_of_body_;
  SupportPoints ends_;  // without the ball
  std::array<double, 2> lengths_;
};

SupportPolygon::SupportPolygon(const Shape& shape, const Pose& pose, const Vector3& n, const Vector3& support_point, double depth,
                               bool without_ball, double thickness)
    : SupportPolygon(View(shape, pose, n, support_point, without_ball), depth, thickness) {}

SupportPolygon::SupportPolygon(const View& view, double depth, double thickness)
    : support_point_(view.support_point_there), axes_({view.pose.rotation * view.axes[0], view.pose.rotation * view.axes[1]}) {
  // The extents of the ellipsoid with the body's half-extents.
  const auto extent = [&](const Vector3& u) { return u.cwiseProduct(view.half_extents).norm(); };
  extents_ = {extent(view.axes[0]), extent(view.axes[1])};
  height_ = extent(view.normal);
  // The height of a tall body does not limit how far it may tilt.
  least_extent_ = std::min({height_, extents_[0], extents_[1]});
  const double least = std::min(least_extent_, thickness);
  reach_ = std::max(depth, std::min(kReach * least + kReachOfDepth * depth, kLargestReach * least));
  const double tangent = tangent_of_tilt(reach_, height_);
  find(view, {tangent, tangent});
}

// `tangents` are the tilts along both axes, in half-heights over half-extents.
void SupportPolygon::find(const View& view, const std::array<double, 2>& tangents) {
  const auto tilts_of = [&](const std::array<double, 2>& of_tilts) {
    evaluations_ += 4;
    return Tilts(view, height_, extents_, of_tilts);
  };
  const Tilts tilts = tilts_of(tangents);
  widths_ = widths_by(tilts);
  if (std::max(tangents[0], tangents[1]) > kNear && std::min(widths_[0], widths_[1]) < 1) {
    const Tilts near = tilts_of({std::min(tangents[0], kNear), std::min(tangents[1], kNear)});
    const std::array<double, 2> from_near = widths_by(near);
    widths_ = {std::max(widths_[0], from_near[0]), std::max(widths_[1], from_near[1])};
  }
  const Tilt slope = tilts.slope();
  slope_ = widths_[0] * slope[0] * axes_[0] + widths_[1] * slope[1] * axes_[1];
  if (!has_width()) return;
  place_vertices(tilts);
  put_axis_across();
}

// The fraction is small where the body is flat and the plane is parallel to the face. Otherwise the tangent plane parallel to the
// face decides.
std::array<double, 2> SupportPolygon::widths_by(const Tilts& tilts) {
  std::array<double, 2> fractions = tilts.fractions({}, {{}, 0});
  if (std::max(fractions[0], fractions[1]) > 1 / kFlatExponent) {
    const Tilt slope = tilts.slope();
    const std::array<double, 2> from_face = tilts.fractions(slope, tilts.point_of(slope));
    fractions = {std::min(fractions[0], from_face[0]), std::min(fractions[1], from_face[1])};
    ++evaluations_;
  }
  const auto width_of = [](double fraction) { return ramp(fraction, 1 / kRoundExponent, 1 / kFlatExponent); };
  return {width_of(fractions[0]), width_of(fractions[1])};
}

void SupportPolygon::place_vertices(const Tilts& tilts) {
  Tilts::SupportPoints points{{Four::Zero(), Four::Zero()}, Four::Zero()};
  if (widths_[0] > 0 && widths_[1] > 0) {
    points = tilts.diagonals();
    evaluations_ += 4;
  }
  const double weight0 = widths_[0] * (1 - widths_[1]);
  const double weight1 = widths_[1] * (1 - widths_[0]);
  const double weight_of_diagonal = widths_[0] * widths_[1];
  const bool is_one = std::max({weight0, weight1, weight_of_diagonal}) == 1;
  // Each diagonal lies between two ends.
  const auto mix = [&](const Four& ends, Four& diagonals) {
    diagonals = weight0 * Four(ends[0], ends[1], ends[1], ends[0]) + weight1 * Four(ends[2], ends[2], ends[3], ends[3]) +
                weight_of_diagonal * diagonals;
  };
  for (std::size_t a = 0; a < 2; ++a) mix(tilts.ends().along[a], points.along[a]);
  mix(tilts.ends().separation, points.separation);
  for (int k = 0; k < 4; ++k) {
    const Vector3 vertex = points.along[0][k] * axes_[0] + points.along[1][k] * axes_[1];
    // A point farther away than the sloped face plus the reach is no part of the face. It moves in along a chord of the body.
    const double beside_face = points.separation[k] - std::max(0.0, slope_.dot(vertex));
    const double share = beside_face > reach_ ? reach_ / beside_face : 1;
    vertices_[static_cast<std::size_t>(k)] = share * vertex;
    largest_separation_ = std::max(largest_separation_, share * points.separation[k]);
    // A point of the tangent plane is on the boundary, too.
    const bool is_known = points.separation[k] == 0 || (share == 1 && is_one && !tilts.has_ball());
    separations_[static_cast<std::size_t>(k)] = is_known ? points.separation[k] : std::numeric_limits<double>::quiet_NaN();
  }
}

// Makes the first axis the short one. Merging joins the manifold points that differ along this axis, which must be at the same end.
void SupportPolygon::put_axis_across() {
  const double length0 = widths_[0] * extents_[0];
  const double length1 = widths_[1] * extents_[1];
  is_long_ = std::max(length0, length1) > kLong * std::min(length0, length1);
  if (length0 <= kLong * length1) return;
  axes_ = {axes_[1], -axes_[0]};
  std::swap(extents_[0], extents_[1]);
  std::swap(widths_[0], widths_[1]);
  std::rotate(vertices_.begin(), vertices_.begin() + 1, vertices_.end());
  std::rotate(separations_.begin(), separations_.begin() + 1, separations_.end());
}

}  // namespace supernormal
