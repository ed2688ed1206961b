#include "contact/manifold/support_polygon.hpp"

#include <algorithm>
#include <cmath>

#include "contact/manifold/unit_root.hpp"
#include "proximity/tangent_plane.hpp"
#include "shapes/superellipsoid_batch.hpp"

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

// The four tilts along the axes and the four along the diagonals, in units of the largest tilt along either axis. The diagonals are
// counter-clockwise. Vertex k lies between the tilts kSideTilts[k][0] and kSideTilts[k][1] along the axes.
constexpr std::array<Tilt, 4> kAxes = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
constexpr std::array<Tilt, 4> kDiagonals = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
constexpr std::array<std::array<std::size_t, 2>, 4> kSideTilts = {{{0, 2}, {1, 2}, {1, 3}, {0, 3}}};

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
  Matrix3 to_body;
  Vector3 normal;
  Vector3 support_point;        // m
  Vector3 support_point_there;  // m; in the frame that the pose refers to
  std::array<Vector3, 2> axes;

  View(const Shape& body, const Pose& pose_of_body, const Vector3& n, const Vector3& point)
      : shape(body),
        pose(pose_of_body),
        to_body(pose.rotation.transpose()),
        normal(to_body * n),
        support_point(to_body * (point - pose.position)),
        support_point_there(point),
        axes(axes_in_plane(normal)) {}
};

/// The points of a body whose normals are tilted against n by the same angle, in units of the half-extents.
class SupportPolygon::Tilts {
 public:
  /// A point of the body, relative to the support point.
  struct SupportPoint {
    Tilt along{};           ///< m; along the axes
    double separation = 0;  ///< m; from the tangent plane
  };
  using SupportPoints = std::array<SupportPoint, 4>;

  Tilts(const View& view, double height, const std::array<double, 2>& extents, const std::array<double, 2>& tangents)
      : shape_(&view.shape),
        n_(view.normal),
        axes_(view.axes),
        support_point_(view.support_point),
        rolling_radius_(view.shape.rolling_radius()),
        extents_(extents),
        largest_({tangents[0] * height / extents[0], tangents[1] * height / extents[1]}),
        half_extents_(view.shape.half_extents()),
        ends_of_body_(points_of(kAxes)),
        ends_(without_ball(ends_of_body_, kAxes)) {}

  /// The points of the four tilts along the axes.
  const SupportPoints& ends() const { return ends_; }

  /// The points of the four diagonals.
  SupportPoints diagonals() const { return without_ball(points_of(kDiagonals), kDiagonals); }

  /// The slope of the line through both ends of each axis; 0 if they coincide.
  Tilt slope() const {
    Tilt slope{};
    for (std::size_t a = 0; a < 2; ++a) {
      const double rise = ends_[2 * a].separation - ends_[2 * a + 1].separation;
      if (has_length(a)) slope[a] = std::clamp(rise / length(a), -largest_[a], largest_[a]);
    }
    return slope;
  }

  /// The fraction D / (D + R) along both axes, for the tangent plane with this slope, which touches the body in `from`. D and R are
  /// the separations from this plane and from the tilted planes. The fraction is 1 along an axis along which the body ends in a
  /// point.
  std::array<double, 2> fractions(const Tilt& slope, const SupportPoint& from) const {
    std::array<double, 2> fractions = {1, 1};
    for (std::size_t a = 0; a < 2; ++a) {
      if (!has_length(a)) continue;
      double separation = 0;
      double of_tilted = 0;
      for (std::size_t end = 2 * a; end < 2 * a + 2; ++end) {
        const SupportPoint& point = ends_of_body_[end];
        Tilt tilt{};
        double above = point.separation - from.separation;
        double sum = 0;
        for (std::size_t b = 0; b < 2; ++b) {
          tilt[b] = kAxes[end][b] * largest_[b];
          const double along = point.along[b] - from.along[b];
          above -= slope[b] * along;
          sum += (tilt[b] - slope[b]) * along;
        }
        above = std::clamp(above, 0.0, std::max(0.0, sum));
        separation += above;
        of_tilted += (sum - above) * size_of(slope) / size_of(tilt);
      }
      fractions[a] = separation + of_tilted > 0 ? separation / (separation + of_tilted) : 0;
    }
    return fractions;
  }

  SupportPoint point_of(const Tilt& tilt) const {
    Jet jet;
    const Vector3 normal = tilted(tilt).normalized();
    shape_->evaluate(normal, Order::Point, jet);
    return relative(jet.r);
  }

 private:
  double length(std::size_t axis) const { return ends_[2 * axis].along[axis] - ends_[2 * axis + 1].along[axis]; }
  bool has_length(std::size_t axis) const { return length(axis) > kLeastLength * extents_[axis]; }

  /// The support function of the ellipsoid with the body's half-extents. In these units its fraction is 1/2 at every tilt.
  double size_of(const Tilt& tilt) const { return tilted(tilt).cwiseProduct(half_extents_).norm(); }

  Vector3 tilted(const Tilt& tilt) const { return n_ + tilt[0] * axes_[0] + tilt[1] * axes_[1]; }

  SupportPoint relative(const Vector3& point) const {
    const Vector3 offset = point - support_point_;
    return {{axes_[0].dot(offset), axes_[1].dot(offset)}, std::max(0.0, -n_.dot(offset))};
  }

  /// A body in which a ball can roll is the sum of the ball and another body. The faces and edges of the sum end where the faces
  /// and edges of the other body end. So the body stands on the points of the other body, moved by the ball's point of the normal
  /// n.
  SupportPoints without_ball(SupportPoints points, const std::array<Tilt, 4>& tilts) const {
    if (rolling_radius_ == 0) return points;
    for (std::size_t k = 0; k < 4; ++k) {
      const Tilt tilt = {tilts[k][0] * largest_[0], tilts[k][1] * largest_[1]};
      const double of_ball = rolling_radius_ / std::sqrt(1 + tilt[0] * tilt[0] + tilt[1] * tilt[1]);
      for (std::size_t a = 0; a < 2; ++a) points[k].along[a] -= of_ball * tilt[a];
      points[k].separation = std::max(0.0, points[k].separation - (rolling_radius_ - of_ball));
    }
    return points;
  }

  SupportPoints points_of(const std::array<Tilt, 4>& tilts) const {
    std::array<Vector3, 4> normals;
    for (std::size_t k = 0; k < 4; ++k) {
      normals[k] = tilted({tilts[k][0] * largest_[0], tilts[k][1] * largest_[1]}).normalized();
    }
    std::array<Jet, 4> jets;
    if (const Superellipsoid* const body = as_superellipsoid(*shape_)) {
      std::array<SuperellipsoidBatch::Request, 4> requests;
      for (std::size_t k = 0; k < 4; ++k) requests[k] = {body, &normals[k], &jets[k]};
      SuperellipsoidBatch::evaluate(requests, Order::Point);
    } else {
      for (std::size_t k = 0; k < 4; ++k) shape_->evaluate(normals[k], Order::Point, jets[k]);
    }
    SupportPoints points;
    for (std::size_t k = 0; k < 4; ++k) points[k] = relative(jets[k].r);
    return points;
  }

  const Shape* shape_;
  Vector3 n_;
  std::array<Vector3, 2> axes_;
  Vector3 support_point_;
  double rolling_radius_;
  std::array<double, 2> extents_;
  Tilt largest_;
  Vector3 half_extents_;
  SupportPoints ends_of_body_;
  SupportPoints ends_;  // without the ball
};

SupportPolygon::SupportPolygon(const Shape& shape, const Pose& pose, const Vector3& n, const Vector3& support_point, double depth,
                               double thickness)
    : SupportPolygon(View(shape, pose, n, support_point), depth, thickness) {}

SupportPolygon::SupportPolygon(const View& view, double depth, double thickness)
    : support_point_(view.support_point_there), axes_({view.pose.rotation * view.axes[0], view.pose.rotation * view.axes[1]}) {
  const Vector3 half_extents = view.shape.half_extents();
  // The extents of the ellipsoid with the body's half-extents.
  const auto extent = [&](const Vector3& u) { return u.cwiseProduct(half_extents).norm(); };
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
  std::array<double, 2> fractions = tilts.fractions({}, {});
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
  Tilts::SupportPoints diagonals{};
  if (widths_[0] > 0 && widths_[1] > 0) {
    diagonals = tilts.diagonals();
    evaluations_ += 4;
  }
  const double weight0 = widths_[0] * (1 - widths_[1]);
  const double weight1 = widths_[1] * (1 - widths_[0]);
  const double weight_of_diagonal = widths_[0] * widths_[1];
  for (std::size_t k = 0; k < 4; ++k) {
    const Tilts::SupportPoint& end0 = tilts.ends()[kSideTilts[k][0]];
    const Tilts::SupportPoint& end1 = tilts.ends()[kSideTilts[k][1]];
    const auto mixed = [&](double of_end0, double of_end1, double of_diagonal) {
      return weight0 * of_end0 + weight1 * of_end1 + weight_of_diagonal * of_diagonal;
    };
    const Vector3 vertex = mixed(end0.along[0], end1.along[0], diagonals[k].along[0]) * axes_[0] +
                           mixed(end0.along[1], end1.along[1], diagonals[k].along[1]) * axes_[1];
    const double separation = mixed(end0.separation, end1.separation, diagonals[k].separation);
    // A point farther away than the sloped face plus the reach is no part of the face. It moves in along a chord of the body.
    const double beside_face = separation - std::max(0.0, slope_.dot(vertex));
    const double share = beside_face > reach_ ? reach_ / beside_face : 1;
    vertices_[k] = share * vertex;
    largest_separation_ = std::max(largest_separation_, share * separation);
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
}

}  // namespace supernormal
