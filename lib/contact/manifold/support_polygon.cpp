#include "contact/manifold/support_polygon.hpp"

#include <algorithm>
#include <cmath>

#include "contact/manifold/unit_root.hpp"
#include "proximity/tangent_plane.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal {
namespace {

// The vertices are where the bodies would overlap if the overlap were so many times as deep. A body at rest overlaps by
// micrometres, and a face that is round in the last digit must not make it rock. With a smaller value, bodies with small
// exponents rock for longer; with a larger one, bodies with little room for contacts fall asleep while they lean.
constexpr double kReach = 12;

// A face like |x|^e with this exponent has its vertices exactly at the reach; a flatter one has them nearer to its end.
constexpr double kFaceExponent = 8;

// Largest reach, in half-heights: beyond it the vertices would hold a body that leans in the air during a fall.
constexpr double kLargestReach = 0.07;

// Largest lean, in half-heights: if it is larger, the far corners of a body that leans hold it in the air, and a stack of bodies
// leans a little more with every step; if it is smaller, bodies with small exponents rock for longer.
constexpr double kLargestLean = 0.035;

// Largest depth, in half-heights, that the tilts grow with: beyond it the vertices would be on the sides of the body.
constexpr double kLargestDepth = 0.2;

// Exponents of faces like |x|^e: up to the first the body is round, from the second on it is flat. The closed forms of rocking
// bodies hold for the first, and bodies come to rest with the second.
constexpr double kRoundExponent = 4;
constexpr double kFlatExponent = 6;

// A face that leans along an axis almost as much as the diagonals do is about to be left by those of the four points that are on
// its far side. These are the shares of the diagonals' tilt at which the polygon begins to shrink along that axis, and has no
// width left.
constexpr double kLeaning = 0.6;
constexpr double kLeaningTooFar = 0.9;

// Share of its width that a round side keeps, so that two lines of contact have a region in common.
constexpr double kThinnest = 1e-3;

// The least spread of the four points, relative to the larger one and squared: along a shorter axis the lean is unknown and taken
// as 0.
constexpr double kLeastSpread = 1e-6;

// The signs of the four vertices along both axes, and for either axis the vertex that each of them faces.
constexpr std::array<std::array<double, 2>, 4> kSigns = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
constexpr std::array<std::array<std::size_t, 4>, 2> kFacing = {{{1, 0, 3, 2}, {3, 2, 1, 0}}};

/// The ramp is 0 up to `zero` and 1 from `one` on, either of which may be the larger. Callers pass constants, so that the compiler
/// computes the quotient.
inline double ramp(double value, double zero, double one) { return std::clamp((value - zero) * (1 / (one - zero)), 0.0, 1.0); }

/// The axes of a body as they lie in the tangent plane: two directions at right angles, such that all the body's axes, and their
/// opposites, are near one of them or its opposite. Axes are added as complex numbers to the power of four, in which these are
/// all the same. So the result depends on the normal continuously, except where the three axes are alike, towards the vertices of
/// a box. All is in the body's frame.
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

/// kReach times the depth, up to a share of the height, but at least the depth itself.
double reach_of(double depth, double height, double largest) { return std::max(depth, std::min(kReach * depth, largest * height)); }

// (kFaceExponent reach / (2 height))^(1 - 1 / kFaceExponent): the slope, in units of height over extent, where a face of that
// exponent has half of the reach as its drop along either axis.
double tangent_of_tilt(double reach, double height) {
  const double x = 0.5 * kFaceExponent * std::min(reach / height, kLargestDepth);
  return std::sqrt(x * std::sqrt(x * std::sqrt(x)));
}

}  // namespace

/// The straight edge of a body that is round across it, a capsule or a cylinder on its side: the two ends. The ends of the body lie
/// beside it on what is round, however far the normal is tilted.
class SupportPolygon::StraightEdge {
 public:
  StraightEdge(const Shape& shape, const Vector3& n, const Vector3& support_point) {
    if (!shape.has_kinks()) return;
    ActiveVertices named;
    shape.add_active_vertices(n, support_point, named);
    if (named.size() != 2) return;
    ends_ = {named[0], named[1]};
    const Vector3 way = ends_[1] - ends_[0];
    const double length = way.norm();
    exists_ = length > 0;
    if (exists_) direction_ = way / length;
  }

  bool exists() const { return exists_; }
  const Vector3& direction() const { return direction_; }

  /// The end that is the support point of a tilted normal, beside which `point`, that of the whole body, is drawn in to the edge.
  Vector3 point_at(const Vector3& tilted, const Vector3& point) const {
    const Vector3& end = tilted.dot(ends_[1] - ends_[0]) > 0 ? ends_[1] : ends_[0];
    const Vector3 beside = point - end;
    return end + kThinnest * (beside - direction_.dot(beside) * direction_);
  }

 private:
  std::array<Vector3, 2> ends_ = {Vector3::Zero(), Vector3::Zero()};
  Vector3 direction_ = Vector3::Zero();
  bool exists_ = false;
};

/// Evaluates points of a body relative to its support point, all in the body's frame.
class SupportPolygon::Observer {
 public:
  Observer(const Shape& shape, const Vector3& n, const std::array<Vector3, 2>& axes, const Vector3& support_point,
           const StraightEdge& edge)
      : shape_(&shape), n_(n), axes_(axes), support_point_(support_point), edge_(edge) {}

  PatchSupport of(const Tilt& tilt) const {
    Jet jet;
    const Vector3 normal = tilted(tilt).normalized();
    shape_->evaluate(normal, Order::Point, jet);
    return sight_of(normal, jet.r);
  }

  /// Finds the support points of the normals that are tilted towards each of the four diagonals.
  std::array<PatchSupport, 4> of_diagonals(const Tilt& diagonal) const {
    const double inverse_length = 1 / std::sqrt(1 + diagonal[0] * diagonal[0] + diagonal[1] * diagonal[1]);
    std::array<Vector3, 4> normals;
    for (std::size_t k = 0; k < 4; ++k) {
      normals[k] = inverse_length * tilted({kSigns[k][0] * diagonal[0], kSigns[k][1] * diagonal[1]});
    }
    std::array<Jet, 4> jets;
    if (const Superellipsoid* const body = shape_->as_superellipsoid()) {
      std::array<Superellipsoid::EvalRequest, 4> requests;
      for (std::size_t k = 0; k < 4; ++k) requests[k] = {body, &normals[k], &jets[k]};
      Superellipsoid::evaluate_four(requests, Order::Point);
    } else {
      for (std::size_t k = 0; k < 4; ++k) shape_->evaluate(normals[k], Order::Point, jets[k]);
    }
    std::array<PatchSupport, 4> sights;
    for (std::size_t k = 0; k < 4; ++k) sights[k] = sight_of(normals[k], jets[k].r);
    return sights;
  }

 private:
  Vector3 tilted(const Tilt& tilt) const { return n_ + tilt[0] * axes_[0] + tilt[1] * axes_[1]; }

  PatchSupport sight_of(const Vector3& normal, const Vector3& point) const {
    const Vector3 way = (edge_.exists() ? edge_.point_at(normal, point) : point) - support_point_;
    return {{axes_[0].dot(way), axes_[1].dot(way)}, std::max(0.0, -n_.dot(way))};
  }

  const Shape* shape_;
  Vector3 n_;
  std::array<Vector3, 2> axes_;
  Vector3 support_point_;
  const StraightEdge& edge_;
};

/// Compares the drops of the four points with the turns, which are the ways to them times the tilts.
class SupportPolygon::View {
 public:
  View(const Tilt& diagonal, double tangent)
      : diagonal_(diagonal), along_one_(std::sqrt(1 + tangent * tangent)), along_both_(std::sqrt(1 + 2 * tangent * tangent)) {}

  /// Computes the shares as seen from the point of the body whose tangent plane has that tilt.
  Shares shares_of(const std::array<PatchSupport, 4>& points, const PatchSupport& from, const Tilt& tilt) const {
    double drop = 0;
    std::array<double, 2> turn{};
    for (std::size_t k = 0; k < 4; ++k) {
      double below = points[k].drop - from.drop;
      for (std::size_t a = 0; a < 2; ++a) {
        const double way = points[k].way[a] - from.way[a];
        below -= tilt[a] * way;
        turn[a] += std::max(0.0, (kSigns[k][a] * diagonal_[a] - tilt[a]) * way);
      }
      drop += std::max(0.0, below);
    }
    return {share_of_drop(drop, turn[0] + turn[1], along_both_),
            {share_of_drop(drop, turn[0], along_one_), share_of_drop(drop, turn[1], along_one_)}};
  }

 private:
  /// The share of the drop in the sum of drop and rise. The turn minus the drop is the rise times the length of the tilted
  /// normal, `stretch`, in units of the half-extents: so an ellipsoid has 1/2 at any tilt.
  static double share_of_drop(double drop, double turn, double stretch) {
    const double rise = std::max(0.0, turn - drop) / stretch;
    return drop + rise > 0 ? drop / (drop + rise) : 0;
  }

  Tilt diagonal_;
  double along_one_;
  double along_both_;
};

SupportPolygon::SupportPolygon(const Shape& shape, const Pose& pose, const Vector3& n, const Vector3& support_point, double depth)
    : support_point_(support_point) {
  const Matrix3 to_body = pose.rotation.transpose();
  const Vector3 normal = to_body * n;
  const Vector3 support = to_body * (support_point - pose.position);
  const StraightEdge edge(shape, normal, support);
  has_straight_edge_ = edge.exists();
  std::array<Vector3, 2> axes = axes_in_plane(normal);
  // Where two corners are united, they are to be at the same end of an edge: those that differ along the first axis.
  if (std::abs(axes[0].dot(edge.direction())) > std::abs(axes[1].dot(edge.direction()))) axes = {axes[1], -axes[0]};
  axes_ = {pose.rotation * axes[0], pose.rotation * axes[1]};
  const Vector3 half_extents = shape.half_extents();
  // The extents are those of the ellipsoid with the body's half-extents.
  const auto extent = [&](const Vector3& u) { return u.cwiseProduct(half_extents).norm(); };
  extents_ = {extent(axes[0]), extent(axes[1])};
  const double height = extent(normal);
  reach_ = reach_of(depth, height, kLargestReach);
  largest_lean_ = reach_of(depth, height, kLargestLean);
  const double tangent = tangent_of_tilt(reach_, height);
  const Tilt diagonal = {tangent * height / extents_[0], tangent * height / extents_[1]};

  const Observer observer(shape, normal, axes, support, edge);
  const std::array<PatchSupport, 4> sights = observer.of_diagonals(diagonal);
  evaluations_ = 4;
  const Tilt tilt = tilt_of_face(sights, diagonal);
  std::array<double, 2> upright{};
  Tilt tilt_that_counts{};
  for (std::size_t a = 0; a < 2; ++a) {
    upright[a] = ramp(std::abs(tilt[a]) / diagonal[a], kLeaningTooFar, kLeaning);
    tilt_that_counts[a] = upright[a] * tilt[a];
  }
  std::array<PatchSupport, 4> points = drawn_in(sights, upright);

  const View view(diagonal, tangent);
  Shares shares = view.shares_of(points, {}, {});
  if (shares.both > 1 / kFlatExponent || std::max(shares.along[0], shares.along[1]) > 2 / kFlatExponent) {
    shares = shares.lesser_of(view.shares_of(points, observer.of(tilt_that_counts), tilt_that_counts));
    ++evaluations_;
  }
  // The drop is that along both axes, so its share along one axis has twice the bounds.
  std::array<double, 2> flat{};
  for (std::size_t a = 0; a < 2; ++a) flat[a] = ramp(shares.along[a], 2 / kRoundExponent, 2 / kFlatExponent);
  flatness_ = ramp(shares.both, 1 / kRoundExponent, 1 / kFlatExponent) * std::max(flat[0] * upright[0], flat[1] * upright[1]);
  if (flatness_ > 0) place_vertices(drawn_in(points, flat), n);
}

// Fits a plane to the four points and returns its tilt, limited to the diagonals; it is level along an axis along which the
// points do not differ.
SupportPolygon::Tilt SupportPolygon::tilt_of_face(const std::array<PatchSupport, 4>& sights, const Tilt& diagonal) const {
  const Vector2 inverse_extents(1 / extents_[0], 1 / extents_[1]);
  std::array<Vector2, 4> ways;
  Vector2 mean = Vector2::Zero();
  double mean_drop = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    ways[k] = {sights[k].way[0] * inverse_extents.x(), sights[k].way[1] * inverse_extents.y()};
    mean += 0.25 * ways[k];
    mean_drop += 0.25 * sights[k].drop;
  }
  Symmetric2 spread;
  Vector2 rise = Vector2::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector2 way = ways[k] - mean;
    spread = spread + Symmetric2{way.x() * way.x(), way.x() * way.y(), way.y() * way.y()};
    rise += (sights[k].drop - mean_drop) * way;
  }
  if (!(spread.trace() > 0)) return {};
  const Vector2 slope = spread.plus_identity(kLeastSpread * spread.trace()).solve(rise);
  return {std::clamp(slope.x() * inverse_extents.x(), -diagonal[0], diagonal[0]),
          std::clamp(slope.y() * inverse_extents.y(), -diagonal[1], diagonal[1])};
}

// Where the body is round along an axis, or leans too far, it stands on the line through the support point: there the chord
// between two points that face one another crosses it. Between flat and round the points are drawn in along this chord, so that
// they stay in the body.
std::array<SupportPolygon::PatchSupport, 4> SupportPolygon::drawn_in(std::array<PatchSupport, 4> points,
                                                                     const std::array<double, 2>& widths) {
  for (std::size_t a = 0; a < 2; ++a) {
    if (widths[a] == 1) continue;  // most faces have full width: their vertices stay where they are
    const double width = std::max(widths[a], kThinnest);
    const std::array<PatchSupport, 4> apart = points;
    for (std::size_t k = 0; k < 4; ++k) {
      const PatchSupport& facing = apart[kFacing[a][k]];
      const double chord = apart[k].way[a] - facing.way[a];
      const double on_line = chord != 0 ? std::clamp(-facing.way[a] / chord, 0.0, 1.0) : 0.5;
      points[k] = apart[k].mixed_with(facing, width + (1 - width) * on_line);
    }
  }
  return points;
}

// Points with a larger drop than the reach are drawn in to the support point.
void SupportPolygon::place_vertices(const std::array<PatchSupport, 4>& points, const Vector3& n) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [way, drop] = points[k];
    const double share = flatness_ * (drop > reach_ ? reach_ / drop : 1);
    vertices_[k] = {share * (way[0] * axes_[0] + way[1] * axes_[1] - drop * n), share * drop};
  }
}

}  // namespace supernormal
