#include "proximity/derivatives/tangent_response.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

using Kind = TangentResponse::Kind;

// Sine: edges closer than this to parallel are parallel. Where they cross is not known to 1e-7 of their length.
constexpr double kParallel = 1e-7;

// In sizes of the smaller body: a point that moves by less as the body rotates by kNearby is on no flat side. With 1e-12 no
// gradient of `pairs flat_derivatives 6000 5`, and 6, changes, and they take 6.7 instead of 4.5 evaluations. Without flat sides 411
// gradients are wrong instead of 3.
constexpr double kFlat = 1e-5;

// Relative to the trace: a smaller eigenvalue is not known to 1e-7.
constexpr double kSingular = 1e-9;

Vector2 quarter_turn(const Vector2& a) { return {-a.y(), a.x()}; }

Matrix2 dense(const Symmetric2& A) {
  Matrix2 M;
  M << A.xx, A.xy, A.xy, A.yy;
  return M;
}

/// Whether a radius of curvature `low` beside a trace is a number and not rounding, and the normal does not rotate by a radian when
/// a body rotates by kNearby.
bool is_known(double low, double trace, double length_unit) { return low > kSingular * trace && low > kNearby * length_unit; }

TangentResponse smooth(const BodyCurvature& body1, const BodyCurvature& body2, double s, double length_unit) {
  const Symmetric2 M = (body1.A + body2.A).plus_identity(s);
  const double trace = body1.A.trace() + body2.A.trace() + std::abs(s);
  if (!(M.xx > 0 && M.yy > 0)) return {};
  // The smaller eigenvalue is at most the determinant over the larger diagonal entry, and at least half of that.
  const double larger = std::max(M.xx, M.yy), smaller = std::min(M.xx, M.yy);
  const double low = smaller - M.xy * (M.xy / larger);
  if (!is_known(low, trace, length_unit)) return {};
  TangentResponse out;
  out.kind = Kind::Regular;
  const double scale = 1 / low;
  out.G << scale * (M.yy / larger), -scale * (M.xy / larger), -scale * (M.xy / larger), scale * (M.xx / larger);
  const Matrix2 A1 = dense(body1.A), A2 = dense(body2.A);
  out.B1.noalias() = out.G * A1;
  out.B2.noalias() = out.G * A2;
  out.W.noalias() = A1 * out.B2;
  return out;
}

/// One body is flat along t. The normal keeps its angle to t in the frame of this body, and tilts along u.
TangentResponse along_edge(const Vector2& t, bool is_edge_of_first, const BodyCurvature& body1, const BodyCurvature& body2,
                           double s, double length_unit) {
  const Symmetric2 M = (body1.A + body2.A).plus_identity(s);
  const Vector2 u = quarter_turn(t), of_u = M * u;
  const double curvature = u.dot(of_u);
  if (!is_known(curvature, body1.A.trace() + body2.A.trace() + std::abs(s), length_unit)) return {};
  TangentResponse out;
  out.kind = Kind::Regular;
  const Matrix2 A1 = dense(body1.A), A2 = dense(body2.A);
  out.G = u * (u / curvature).transpose();
  out.B1 = out.G * A1;
  out.B2 = out.G * A2;
  const Matrix2 turned = (t - u * (of_u.dot(t) / curvature)) * t.transpose();
  (is_edge_of_first ? out.B1 : out.B2) += turned;
  out.W = is_edge_of_first ? Matrix2(out.B1.transpose() * A2) : Matrix2(A1 * out.B2);
  return out;
}

/// Two edges that cross: the normal is perpendicular to both.
TangentResponse across_edges(const BodyCurvature& body1, const BodyCurvature& body2, double s) {
  const Vector2 &t1 = body1.flat[0], &t2 = body2.flat[0];
  const double sine = cross(t1, t2);
  if (!(std::abs(sine) > kParallel)) return {.kind = Kind::Free};
  const Vector2 d1 = -quarter_turn(t2) / sine, d2 = quarter_turn(t1) / sine;  // d1.t1 = d2.t2 = 1, d1.t2 = d2.t1 = 0
  const Symmetric2 M = (body1.A + body2.A).plus_identity(s);
  TangentResponse out;
  out.kind = Kind::Regular;
  out.B1 = d1 * t1.transpose();
  out.B2 = d2 * t2.transpose();
  out.W = dense(body1.A) * out.B2 + out.B1.transpose() * dense(body2.A) - t1 * (d1.dot(M * d2) * t2).transpose();
  return out;
}

}  // namespace

void BodyCurvature::flatten(const Vector2& direction) {
  const Vector2 unit = direction.normalized();
  if (flat_count == 2 || is_flat_along(unit)) return;
  flat[static_cast<std::size_t>(flat_count++)] = unit;
}

bool BodyCurvature::is_flat_along(const Vector2& direction) const {
  return flat_count == 2 || (flat_count == 1 && std::abs(cross(flat[0], direction)) <= kParallel);
}

Symmetric2 BodyCurvature::across_flat() const {
  if (flat_count == 0) return A;
  if (flat_count == 2) return {};
  const Vector2 u = quarter_turn(flat[0]);
  const double radius = u.dot(A * u);
  return {radius * u.x() * u.x(), radius * u.x() * u.y(), radius * u.y() * u.y()};
}

bool BodyCurvature::may_be_flat(double size) const { return flat_count > 0 || kNearby * A.trace() > kFlat * size; }

TangentResponse TangentResponse::of(const BodyCurvature& body1, const BodyCurvature& body2, double s, double length_unit) {
  const int flat_count = body1.flat_count + body2.flat_count;
  if (flat_count == 0) return smooth(body1, body2, s, length_unit);
  if (flat_count > 2) return {.kind = Kind::Free};
  if (body1.flat_count == 1 && body2.flat_count == 1) return across_edges(body1, body2, s);
  if (flat_count == 1) {
    const bool is_edge_of_first = body1.flat_count == 1;
    return along_edge(is_edge_of_first ? body1.flat[0] : body2.flat[0], is_edge_of_first, body1, body2, s, length_unit);
  }
  // A face: the normal rotates with its body.
  TangentResponse out;
  out.kind = Kind::Regular;
  (body1.flat_count == 2 ? out.B1 : out.B2).setIdentity();
  out.W = dense(body1.flat_count == 2 ? body2.A : body1.A);
  return out;
}

bool TangentResponse::is_near(const TangentPlane& plane, const TangentResponse& other, const TangentPlane& others, double part,
                              double largest) const {
  if (kind != Kind::Regular || other.kind != Kind::Regular) return false;
  Matrix2 turn;
  turn << plane.t1.dot(others.t1), plane.t1.dot(others.t2), plane.t2.dot(others.t1), plane.t2.dot(others.t2);
  const auto is_same = [&](const Matrix2& here, const Matrix2& there, double unit) {
    return (turn * there * turn.transpose() - here).norm() <= part * std::max(here.norm(), unit);
  };
  return is_same(G, other.G, 1 / largest) && is_same(B1, other.B1, 1) && is_same(B2, other.B2, 1);
}

}  // namespace supernormal
