#include "proximity/derivatives/common_normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/finite.hpp"
#include "proximity/gap/limits.hpp"
#include "proximity/gap/tuning.hpp"

namespace supernormal {
namespace {

// Gnomonic: after a smaller step the normal is exact to rounding, and so are the radii of curvature of a round body.
constexpr double kSmallStep = 1e-10;

// Of each component of a body's normal: beside a flat side the radii of curvature are powers of it. After a smaller tilt they are
// known to 1e-8. Without it one in 100 nearly flat pairs is off by more than 1e-7, up to 2e-4. With 1e-7 none is, after 2 % fewer
// evaluations, and with 1e-9 none after 3 % more.
constexpr double kSmallTilt = 1e-8;

// A larger last step leaves derivatives that are no more than estimates.
constexpr double kLargestStep = 1e-7;

// Two as a rule. Some sharp bodies on an edge converge linearly: after 8 the last step may be 1e-7, and the derivatives are off by
// 1e-6.
constexpr int kMostSteps = 32;

// Of a step that led down. With 0.5, 12 000 flat pairs (`pairs flat_derivatives 6000 5`, and 6) take 4.66 instead of 4.51
// evaluations.
constexpr double kShorter = 0.25;

// Of the radius of curvature across an infinite one: a body not aligned with its axes, of 1e10 half-extents in one direction, tells
// the other radius no better.
constexpr double kLeastDigits = 1e-6;

// The weight of a vertex in a witness point, and the distance of a point from the border of its face, relative to the face: less is
// rounding.
constexpr double kNoWeight = 1e-9;

// rad: a normal that rotates by less as a body rotates by kNearby is not between two sharp points. Without this look 7 gradients
// are wrong instead of 3.
constexpr double kSharp = 1e-3;

// In sizes of its body: a point of a curved edge that moves by more as the normal rotates by kNearby is beside a curved face.
constexpr double kBesideFace = 1e-3;

// In units of the bodies' sizes: the curvature of a model whose own is not positive, or rounding. At the maximum the weights do not
// depend on it.
constexpr double kLeastCurvature = 1e-3;

/// The radii of curvature A in a basis whose first vector has the coordinates (cosine, sine).
Symmetric2 rotated(const Symmetric2& A, double cosine, double sine) {
  const double xx = A.xx * cosine - A.xy * sine, xy = A.xx * sine + A.xy * cosine;
  const double yx = A.xy * cosine - A.yy * sine, yy = A.xy * sine + A.yy * cosine;
  return {cosine * xx - sine * yx, cosine * xy - sine * yy, sine * xy + cosine * yy};
}

/// m; what rounding leaves unknown of the radius across a very large one. The large radius spreads over the whole matrix unless it
/// is along an axis of the body's frame.
double rounding_across(const Symmetric2& A, const Matrix3& H) {
  int axis = 0;
  H.diagonal().maxCoeff(&axis);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double beside = std::max({std::abs(H(i, i)), std::abs(H(i, j)), std::abs(H(j, j))});
  return std::numeric_limits<double>::epsilon() * (beside + std::abs(A.xy));
}

/// The radii of a body in a basis of the tangent plane, both in the body's frame.
BodyCurvature curvature_in(const TangentPlane& basis, const Matrix3& H, double flattest) {
  BodyCurvature out;
  out.A = Symmetric2::project(basis, H);
  if (out.A.trace() <= flattest) return out;
  // In a basis aligned with the body, nothing of a very large radius is in the other.
  const TangentPlane own = TangentPlane::along_flattest(basis.n, H);
  const Symmetric2 A = Symmetric2::project(own, H);
  const Eigen2 radii(A);
  if (radii.high <= flattest) return out;
  const double cosine = own.t1.dot(basis.t1), sine = own.t1.dot(basis.t2);
  const auto in_basis = [&](const Vector2& v) { return Vector2(cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()); };
  const Vector2 other = in_basis(radii.low_vector);
  out.flatten(in_basis(radii.high_vector));
  out.A = {};
  if (radii.low > flattest) {
    out.flatten(other);
  } else {
    const double low = std::max(radii.low, 0.0);
    out.rounding = rounding_across(A, H);
    out.A = {low * other.x() * other.x(), low * other.x() * other.y(), low * other.y() * other.y()};
  }
  return out;
}

/// The active vertices of a body, or its boundary point if it has none.
ActiveVertices vertices_of(const Shape& shape, bool has_nonsmooth_points, const Vector3& n, const Jet& jet, const Vector3& toward) {
  ActiveVertices vertices;
  if (has_nonsmooth_points) shape.add_active_vertices(n, toward, vertices);
  if (vertices.size() == 0) vertices.add(jet.r);
  return vertices;
}

/// The same curvature in a basis whose first vector is `t`, a unit vector.
BodyCurvature aligned(const BodyCurvature& body, const Vector2& t) {
  BodyCurvature out = body;
  out.A = rotated(body.A, t.x(), -t.y());
  for (Vector2& flat : out.flat) flat = {t.dot(flat), cross(t, flat)};
  return out;
}

/// The finite radii, with a large one in place of an infinite one.
Symmetric2 bounded(const BodyCurvature& body, double largest) {
  Symmetric2 A = body.A;
  for (int k = 0; k < body.flat_count; ++k) {
    const Vector2& t = body.flat[static_cast<std::size_t>(k)];
    A = A + Symmetric2{largest * t.x() * t.x(), largest * t.x() * t.y(), largest * t.y() * t.y()};
  }
  return A;
}

/// Whether the origin is inside the convex hull of these points, by kNearby and more: the line through each of them has others on
/// both sides.
bool surround_origin(std::span<const Vector2> points, double size) {
  return std::all_of(points.begin(), points.end(), [&](const Vector2& point) {
    const auto is_beside = [&](double side) {
      return std::any_of(points.begin(), points.end(),
                         [&](const Vector2& other) { return side * cross(point, other) > kNearby * point.norm() * other.norm(); });
    };
    return point.norm() > kNearby * size && is_beside(1) && is_beside(-1);
  });
}

}  // namespace

CommonNormal::CommonNormal(GapFunction& gap, const Vector3& start)
    : gap_(gap),
      has_nonsmooth_points_(gap.traits1().has_nonsmooth_points || gap.traits2().has_nonsmooth_points),
      has_flat_faces_(gap.traits1().has_flat_faces || gap.traits2().has_flat_faces) {
  std::array<Place, 2> places;
  std::size_t best = 0;
  if (!look_at(start, places[best])) return;
  const double least_gap = places[best].jet.s - kMostSteps * gap_.rounding();
  double part = 1;
  while (!is_settled(places[best]) && gap_.evaluations() < kMostSteps) {
    if (!look_at(moved(places[best], part), places[1 - best])) break;
    // A step that leads down was too long: the pieces of a model may change, and on a nearly flat side the other body's point, too.
    if (places[1 - best].jet.s < places[best].jet.s - gap_.rounding()) {
      part *= kShorter;
      continue;
    }
    const bool must_gain = !has_nonsmooth_points_ || places[best].step.norm() <= kSmallStep;
    if (must_gain && !(places[1 - best].rest < places[best].rest)) break;
    part = 1;
    best = 1 - best;
  }
  finish(places[best]);
  // Where it ends before the radii are known, the next normal tells whether that matters.
  const double largest = std::max(gap_.shape1().half_extents().norm(), gap_.shape2().half_extents().norm());
  const TangentResponse &here = places[best].response, &beside = places[1 - best].response;
  is_strict_ = is_strict_ && (is_settled(places[best]) || here.kind != TangentResponse::Kind::Regular ||
                              here.is_near(places[best].plane, beside, places[1 - best].plane, kLeastDigits, largest));
  // The answer is a maximum. A lower one is another.
  is_converged_ = is_converged_ && s_ >= least_gap;
}

/// Whether the step leaves the radii of curvature as they are, but for tilts below `rounding` (rad).
bool CommonNormal::keeps_radii(const Place& place, double rounding) const {
  if (place.has_active_set) return true;
  const Vector3 dn = place.plane.lift(place.response.G * place.across);  // along an infinite radius nothing changes
  const auto is_small = [rounding](const ShapeTraits& traits, const Vector3& tilt, const Vector3& own) {
    return !traits.has_flat_faces || (tilt.array().abs() <= kSmallTilt * own.array().abs() + rounding).all();
  };
  return is_small(gap_.traits1(), dn, place.jet.n) && is_small(gap_.traits2(), gap_.rotation().transpose() * dn, place.jet.m);
}

/// Whether both the normal and the radii of curvature are known.
bool CommonNormal::is_settled(const Place& place) const {
  return place.step.norm() <= kSmallStep && keeps_radii(place, std::numeric_limits<double>::epsilon());
}

bool CommonNormal::look_at(const Vector3& n, Place& place) {
  gap_.evaluate(n, Order::Hessian, place.jet);
  const GapJet& jet = place.jet;
  if (!jet.is_finite() || !all_finite(jet.jet1.H) || !all_finite(jet.jet2.H)) return false;
  const double flattest = limits::kFlattest * gap_.length_unit();
  place.plane = TangentPlane::along_flattest(jet.n, jet.jet1.H);
  place.body1 = curvature_in(place.plane, jet.jet1.H, flattest);
  place.body2 = curvature_in(place.plane.rotated(gap_.rotation().transpose()), jet.jet2.H, flattest);
  place.point1 = jet.jet1.r;
  place.point2 = jet.jet2.r;
  place.has_active_set = place.is_near_border = false;
  place.is_strict = true;
  if (has_nonsmooth_points_) {
    find_active_set(place);
  } else {
    place.across = place.plane.project(jet.d);
  }
  place.response = TangentResponse::of(place.body1, place.body2, jet.s, gap_.length_unit());
  if (!place.has_active_set) place.step = place.response.G * place.across;
  if (!has_nonsmooth_points_) {
    add_flat_step(place.body1, jet.jet1.H, Matrix3::Identity(), place);
    add_flat_step(place.body2, jet.jet2.H, gap_.rotation().transpose(), place);
  }
  place.rest = place.across.dot(place.response.G * place.across);
  return std::isfinite(place.rest) && all_finite(place.step);
}

/// The response has an infinite radius in place of one above kFlattest, and no step along it.
void CommonNormal::add_flat_step(const BodyCurvature& body, const Matrix3& H, const Matrix3& to_body, Place& place) const {
  for (int k = 0; k < body.flat_count; ++k) {
    const Vector2& t = body.flat[static_cast<std::size_t>(k)];
    const Vector3 own = to_body * place.plane.lift(t);
    place.step += t * (t.dot(place.across) / own.dot(H * own));
  }
}

/// Finds which vertices of both bodies support the maximum of the model, the witness points between them, and the step. Then the
/// radius of curvature along their edges is infinite.
void CommonNormal::find_active_set(Place& place) const {
  // In another basis, rounding spreads an infinite radius over the whole matrix, and nothing is left of the radius across it.
  // Beside the axis of a cap the step would then lead away from the axis.
  if (place.body1.flat_count + place.body2.flat_count > 0) {
    const Vector2 t = place.body1.flat_count > 0 ? place.body1.flat[0] : place.body2.flat[0];
    place.plane = TangentPlane(place.plane.n, place.plane.lift(t));
    place.body1 = aligned(place.body1, t);
    place.body2 = aligned(place.body2, t);
  }
  const GapJet& jet = place.jet;
  const Matrix3& R = gap_.rotation();
  const ActiveVertices one = vertices_of(gap_.shape1(), gap_.traits1().has_nonsmooth_points, jet.n, jet.jet1, jet.jet1.r + jet.d);
  const ActiveVertices two = vertices_of(gap_.shape2(), gap_.traits2().has_nonsmooth_points, jet.m, jet.jet2,
                                         R.transpose() * (jet.jet1.r - gap_.offset()));
  const double size = gap_.shape1().half_extents().norm() + gap_.shape2().half_extents().norm();
  const double infinite = size / std::numeric_limits<double>::epsilon();  // the normal of a flat side does not move
  const double nothing = kTieUnits * std::numeric_limits<double>::epsilon() * (size + jet.jet1.r.norm() + jet.jet2.r.norm());
  Symmetric2 A = (bounded(place.body1, infinite) + bounded(place.body2, infinite)).plus_identity(jet.s);
  const double low = Eigen2(A).low, least = kLeastCurvature * size;
  if (low <= nothing) A = A.plus_identity(least - low);
  // In these units of the step both radii are as large as the bodies, and the multipliers keep their digits.
  const Vector2 unit(std::sqrt(size / A.xx), std::sqrt(size / A.yy));
  A = {size, unit.x() * A.xy * unit.y(), size};
  std::array<Piece, std::size_t{ActiveVertices::kCapacity} * ActiveVertices::kCapacity> pieces;
  std::size_t count = 0;
  for (int i = 0; i < one.size(); ++i) {
    for (int j = 0; j < two.size(); ++j) {
      const double below1 = std::max(jet.jet1.h - jet.n.dot(one[i]), 0.0), below2 = std::max(jet.jet2.h - jet.m.dot(two[j]), 0.0);
      pieces[count++] = {below1 + below2, unit.cwiseProduct(place.plane.project(R * two[j] + (gap_.offset() - one[i])))};
    }
  }
  place.peak = PiecewiseModel{{pieces.data(), count}, A}.maximize();
  place.step = unit.cwiseProduct(place.peak.u);

  place.point1.setZero();
  place.point2.setZero();
  double weights = 0;
  std::array<std::size_t, 3> active{};
  std::size_t active_count = 0;
  for (std::size_t k = 0; k < place.peak.count; ++k) {
    const double weight = place.peak.weight[k];
    const auto pair = static_cast<int>(place.peak.active[k]);
    place.point1 += weight * one[pair / two.size()];
    place.point2 += weight * two[pair % two.size()];
    weights += weight;
    if (weight > kNoWeight) active[active_count++] = place.peak.active[k];
  }
  place.point1 /= weights;
  place.point2 /= weights;
  place.across = place.plane.project(R * place.point2 + (gap_.offset() - place.point1));
  place.is_strict = active_count == place.peak.count;
  place.has_active_set = active_count > 1;

  const auto vertex1 = [&](std::size_t pair) -> const Vector3& { return one[static_cast<int>(pair) / two.size()]; };
  const auto vertex2 = [&](std::size_t pair) -> const Vector3& { return two[static_cast<int>(pair) % two.size()]; };
  // The edges between active vertices, each of its own body.
  const auto edge1 = [&](std::size_t pair) -> Vector2 { return place.plane.project(vertex1(pair) - vertex1(active[0])); };
  const auto edge2 = [&](std::size_t pair) -> Vector2 { return place.plane.project(R * (vertex2(pair) - vertex2(active[0]))); };
  double length = 0;
  for (std::size_t k = 1; k < active_count; ++k) {
    const Vector2 first = edge1(active[k]), second = edge2(active[k]);
    if (first.norm() > nothing) place.body1.flatten(first);
    if (second.norm() > nothing) place.body2.flatten(second);
    length = std::max(length, first.norm() + second.norm());
  }
  // A weight is the distance from the border relative to the face.
  const auto weights_end = place.peak.weight.begin() + static_cast<std::ptrdiff_t>(place.peak.count);
  const double least_weight = *std::min_element(place.peak.weight.begin(), weights_end);
  place.is_near_border = place.peak.count > 1 && least_weight * length < kNearby * (length + place.slide());
  // Another vertex with the same height, off the active edges, takes over as soon as the bodies move. If both bodies then share a
  // direction, their faces or edges have more than a point in common.
  BodyCurvature all1 = place.body1, all2 = place.body2;
  std::array<Vector2, pieces.size()> around1, around2;  // the tied vertices, seen from the witness points
  std::size_t tied = 0;
  const double height = place.peak.gain + 0.5 * place.peak.u.dot(A * place.peak.u);
  for (std::size_t pair = 0; pair < count; ++pair) {
    const Vector2 first = edge1(pair), second = edge2(pair);
    const bool is_active = std::find(active.begin(), active.begin() + active_count, pair) != active.begin() + active_count;
    const double below = pieces[pair].at(place.peak.u) - height;
    // On a flat side there is no step, and this normal counts.
    const double nearest = std::min(below, pieces[pair].value);
    place.is_near_border = place.is_near_border || (!is_active && nearest <= kNearby * (first.norm() + second.norm()) + nothing);
    if (below > nothing) continue;
    if (first.norm() > nothing) all1.flatten(first);
    if (second.norm() > nothing) all2.flatten(second);
    around1[tied] = place.plane.project(vertex1(pair) - place.point1);
    around2[tied++] = place.plane.project(R * (vertex2(pair) - place.point2));
  }
  if (all1.flat_count == place.body1.flat_count && all2.flat_count == place.body2.flat_count) return;
  // On a diagonal of a face two vertices have all the weight, but the point is not on the face's border.
  const bool is_inside = (all1.flat_count == 2 && all2.flat_count == 0 && surround_origin({around1.data(), tied}, size)) ||
                         (all2.flat_count == 2 && all1.flat_count == 0 && surround_origin({around2.data(), tied}, size));
  if (is_inside) {
    place.has_active_set = place.is_strict = true;
    place.body1 = all1;
    place.body2 = all2;
    return;
  }
  place.is_strict = false;
  if (TangentResponse::of(all1, all2, jet.s, gap_.length_unit()).kind == TangentResponse::Kind::Free) {
    place.body1 = all1;
    place.body2 = all2;
  }
}

/// The normal of the next evaluation, after this part of the step. On a flat face the normal is a smooth function of the boundary
/// point, and not the other way round, so the flatter body's point moves.
Vector3 CommonNormal::moved(const Place& place, double part) const {
  const Vector3 dn = place.plane.lift(part * place.step);
  const GapJet& jet = place.jet;
  const Matrix3& R = gap_.rotation();
  Vector3 next = jet.n + dn;
  // An infinite radius is not part of A.
  if (has_flat_faces_ && !place.has_active_set) {
    const bool is_first = place.body1.flat_count != place.body2.flat_count ? place.body1.flat_count > place.body2.flat_count
                                                                           : place.body1.A.trace() >= place.body2.A.trace();
    const Vector3 own = is_first ? jet.n : jet.m, tilt = is_first ? dn : Vector3(-(R.transpose() * dn));
    const Shape& shape = is_first ? gap_.shape1() : gap_.shape2();
    if ((tilt.array().abs() > kTuning.same_tilt * own.array().abs()).any()) {
      const Vector3 direction = shape.advance_normal(own, is_first ? jet.jet1 : jet.jet2, tilt);
      if (all_finite(direction) && direction.dot(own) > 0) next = is_first ? direction : Vector3(-(R * direction));
    }
  }
  // A step that leads across the normal of a curved face ends there.
  Vector3 face;
  if (gap_.traits1().has_nonsmooth_points && gap_.shape1().crosses_curved_face(jet.n, next, face)) return face;
  if (gap_.traits2().has_nonsmooth_points && gap_.shape2().crosses_curved_face(jet.m, -(R.transpose() * next), face)) {
    return -(R * face);
  }
  return next.normalized();
}

/// Of two flat bodies, the one whose point moves less as the normal tilts is flat at this point only, or nearly. Its point is
/// known, and the other body's is opposite. A body with a face may have any point of it.
void CommonNormal::choose_points(const Place& place) {
  if (gap_.traits1().has_nonsmooth_points && gap_.traits2().has_nonsmooth_points) return;
  GapJet beside;
  gap_.evaluate((place.jet.n + place.plane.lift({kNearby, kNearby})).normalized(), Order::Point, beside);
  const double move1 = (beside.jet1.r - place.jet.jet1.r).norm(), move2 = (beside.jet2.r - place.jet.jet2.r).norm();
  if (gap_.traits2().has_nonsmooth_points || (!gap_.traits1().has_nonsmooth_points && move1 <= move2)) {
    lever2_ = point1_ + s_ * n_ - gap_.offset();
  } else {
    point1_ = lever2_ + gap_.offset() - s_ * n_;
  }
}

/// The last step moves the witness points to first order.
void CommonNormal::finish(const Place& place) {
  const Matrix3& R = gap_.rotation();
  plane_ = place.plane;
  response_ = place.response;
  active_set_ = place.has_active_set;
  is_strict_ = place.is_strict && (place.body1.rounding + place.body2.rounding) * place.response.G.norm() <= kLeastDigits;
  n_ = (place.jet.n + place.plane.lift(place.step)).normalized();
  point1_ = place.point1 + place.plane.lift(place.response.B1.transpose() * place.across);
  lever2_ = R * place.point2 - place.plane.lift(place.response.B2.transpose() * place.across);
  s_ = place.jet.s;
  if (place.response.kind == TangentResponse::Kind::Free) choose_points(place);
  is_converged_ = place.step.norm() <= kLargestStep && all_finite(point1_) && all_finite(lever2_);
  const double size1 = gap_.shape1().half_extents().norm(), size2 = gap_.shape2().half_extents().norm(),
               size = std::min(size1, size2);
  is_sharp_ = kNearby * size * place.response.G.norm() > kSharp;
  const auto is_beside_face = [&](const ShapeTraits& traits, const BodyCurvature& body, double own_size) {
    const bool is_flat_rim = body.flat_count > 0 && !place.has_active_set;
    return traits.has_nonsmooth_points && (is_flat_rim || kNearby * body.A.trace() > kBesideFace * own_size);
  };
  may_change_nearby_ = is_sharp_ || place.is_near_border || is_beside_face(gap_.traits1(), place.body1, size1) ||
                       is_beside_face(gap_.traits2(), place.body2, size2) ||
                       (place.body1.may_be_flat(size) && place.body2.may_be_flat(size));
  radii1_ = place.body1.across_flat();
  radii2_ = place.body2.across_flat();
}

}  // namespace supernormal
