#include "supernormal/shapes/superellipsoid.hpp"

#include <algorithm>
#include <cmath>

#include "base/validation.hpp"
#include "shapes/lanes/lane_body_of.hpp"
#include "shapes/lanes/powers.hpp"
#include "shapes/nested_norms.hpp"
#include "shapes/superellipsoid_batch.hpp"

namespace supernormal {
namespace {

// Below this exponent edges and vertices are so sharp that any overlap may have several local maxima.
constexpr double kSharpExponent = 1.3;

// With exponents up to this, the caps of a superellipsoid are wider than an ellipsoid's by at most 0.21 of the body's width.
constexpr double kMostRound = 3;

// power() takes exponents up to this.
constexpr double kMostPower = 1000;

/// An estimate of the smallest radius of curvature of a superellipse with half-axes 1. For an exponent e > 2 it is 1/(e - 1) at the
/// rounded corners, within a factor of 1.5. Below 2 the radius is 0 at the vertices, but larger around them.
double relative_radius(double exponent) {
  if (exponent >= 2) return 1 / (exponent - 1);
  return std::max(0.0, (exponent - kSharpExponent) / (2 - kSharpExponent));
}

/// The radius of a ball that rolls freely inside the superellipsoid with half-axes 1. It is 0 if there is none: an exponent below 2
/// has vertices or edges.
///
/// The support function nests two p-norms with dual exponents p in (1, 2]. With c and s the cosine and sine of the normal's angle,
/// the radius of curvature of a p-norm is
///     (p-1) (c s)^(p-2) / (c^p + s^p)^(2 - 1/p).
/// It is least at 45 degrees, where it is (p-1) 2^(1/p - 1/2). The norm itself is between 1 and 2^(1/p - 1/2). Let t be the inner
/// norm of a unit vector. Let mu and gamma be the components of a unit tangent vector along the meridian and across it. By the
/// chain rule the second derivative along the tangent vector is at least
///     along (mu - slope gamma)^2 + across gamma^2,    slope = |t'|/t <= 2 - p.
/// This is at least the smaller eigenvalue of the quadratic form, which is the result. The bound on the slope: with x <= 1 the
/// tangent of the angle, t'/t = (x^(p-1) - x)/(1 + x^p), which is convex in p and 0 for p = 2.
double unit_rolling_radius(double delta, double epsilon) {
  if (delta < 2 || epsilon < 2) return 0;
  const double p = delta / (delta - 1), q = epsilon / (epsilon - 1);
  const auto raise = [](double base, double exponent) { return root(Real<1>(base), Real<1>(exponent)).v; };
  const double largest_inner = raise(2, 1 / p - 0.5), largest_outer = raise(2, 1 / q - 0.5);
  const double along = largest_outer / (epsilon - 1) / largest_inner;
  const double across = largest_inner / (delta - 1) / raise(largest_inner * largest_outer, q - 1);
  const double slope = 2 - p;
  const double along_both = along * (1 + slope * slope);
  const double difference = along_both - across;
  const double discriminant = std::sqrt(difference * difference + 4 * slope * slope * along * across);
  return 2 * along * across / (along_both + across + discriminant);
}

/// The same for half-axes in m: the smallest and largest half-axis stretch the ball to an ellipsoid.
double rolling_radius_of(const Vector3& half_axes, double delta, double epsilon) {
  const double smallest = half_axes.minCoeff();
  return smallest * (smallest / half_axes.maxCoeff()) * unit_rolling_radius(delta, epsilon);
}

/// m; the distance of a superellipse's farthest point from its centre. Let u and v be the coordinates over the half-axes:
/// |u|^e + |v|^e = 1. By Hoelder's inequality the squared distance, a^2 u^2 + b^2 v^2, is at most the norm of (a^2, b^2) with the
/// exponent e/(e - 2). A smaller exponent of the norm gives a larger radius, so its limit does no harm.
double largest_radius(double a, double b, double exponent) {
  const double larger = std::max(a, b), ratio = std::min(a, b) / larger;
  if (exponent <= 2) return larger;
  const double norm = std::min(2 * exponent / (exponent - 2), kMostPower);
  return larger * root(Real<1>(1 + power(Real<1>(ratio), Real<1>(norm)).v), Real<1>(1 / norm)).v;
}

ShapeTraits traits_of(double delta, double epsilon) {
  return {.has_hessian = true,
          .is_symmetric = true,
          .is_round = std::min(delta, epsilon) >= 2 && std::max(delta, epsilon) <= kMostRound,
          .has_flat_faces = delta > 2 || epsilon > 2,
          .has_axis_aligned_faces = true};
}

// With equal exponents the two norms are one norm of three numbers. A sharp body does not use this, because its high powers p
// amplify the rounding of the ratios.
bool is_one_norm_at(const Superellipsoid& body, const Vector3& n) {
  const Vector3 scaled = body.half_axes().cwiseProduct(n).cwiseAbs();
  return body.delta() == body.epsilon() && body.delta() >= 2 && PowerNorm::is_plain(scaled.x(), scaled.y(), scaled.z());
}

void assemble(const PowerNorm3Request& norm, const Vector3& half_axes, const Vector3& n, Order order, Jet& jet) {
  jet.h = norm.value;
  if (order == Order::Value) return;
  for (int i = 0; i < 3; ++i) jet.r[i] = std::copysign(half_axes[i] * norm.slope[static_cast<std::size_t>(i)], n[i]);
  if (order == Order::Point) return;
  const double scale = -norm.norm->p_minus_1() / norm.value;
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    jet.H(i, i) = half_axes[i] * half_axes[i] * (norm.bend[static_cast<std::size_t>(i)] / norm.value);
    jet.H(i, next) = jet.H(next, i) = scale * jet.r[i] * jet.r[next];
  }
}

void assemble(const PowerNormJet& inner, const PowerNormJet& outer, const Vector3& half_axes, const Vector3& n, Order order,
              Jet& jet) {
  jet.h = outer.value;
  if (order == Order::Value) return;
  const Vector3 signed_axes(std::copysign(half_axes.x(), n.x()), std::copysign(half_axes.y(), n.y()),
                            std::copysign(half_axes.z(), n.z()));
  jet.r = signed_axes.cwiseProduct(Vector3(outer.dx * inner.dx, outer.dx * inner.dy, outer.dy));
  if (order == Order::Point) return;

  // The chain rule: the inner second derivatives are inner.xx / t and so on, and outer.dx / t stays finite at the pole t = 0.
  const double tt = outer.xx / outer.value;
  const double tz = outer.xy / outer.value;
  const double slope = outer.dx_over_x / outer.value;
  Matrix3& H = jet.H;
  H(0, 0) = tt * inner.dx * inner.dx + slope * inner.xx;
  H(0, 1) = tt * inner.dx * inner.dy + slope * inner.xy;
  H(1, 1) = tt * inner.dy * inner.dy + slope * inner.yy;
  H(0, 2) = tz * inner.dx;
  H(1, 2) = tz * inner.dy;
  H(2, 2) = outer.yy / outer.value;
  H(1, 0) = H(0, 1);
  H(2, 0) = H(0, 2);
  H(2, 1) = H(1, 2);
  H.array() *= (signed_axes * signed_axes.transpose()).array();
}

// With equal exponents the two norms are one norm of three numbers, and the direction of its gradient takes no root.
Vector3 along_gauge_gradient(const PowerNorm& gauge, const Vector3& half_axes, const Vector3& gauge_point, const Vector3& signs) {
  const double largest = gauge_point.maxCoeff();
  Vector3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const double ratio = gauge_point[axis] < largest ? gauge_point[axis] / largest : 1;
    gradient[axis] = std::copysign(gauge.slope(ratio), signs[axis]);
  }
  return gradient.cwiseQuotient(half_axes);
}

}  // namespace

Superellipsoid::Superellipsoid(const Vector3& half_axes, double delta, double epsilon)
    : half_axes_(require_half_axes(half_axes)),
      delta_(require_in("delta", delta, kMinExponent, kMaxExponent)),
      epsilon_(require_in("epsilon", epsilon, kMinExponent, kMaxExponent)),
      norms_(std::make_shared<const NestedNorms>(delta, epsilon)),
      traits_(traits_of(delta, epsilon)),
      rolling_radius_(rolling_radius_of(half_axes_, delta, epsilon)),
      bounding_radius_(largest_radius(largest_radius(half_axes_.x(), half_axes_.y(), delta), half_axes_.z(), epsilon)),
      numbers_(make_lane_body(*this, half_axes, delta, epsilon)) {}

template <std::size_t kCount>
void SuperellipsoidBatch::evaluate_by_one_norm(const std::array<Request, kCount>& requests, Order order) {
  std::array<PowerNorm3Request, kCount> norms;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Superellipsoid& body = *requests[i].body;
    const Vector3 scaled = body.half_axes_.cwiseProduct(*requests[i].n).cwiseAbs();
    norms[i] = {&body.norms_->inner_support, {scaled.x(), scaled.y(), scaled.z()}};
  }
  PowerNorm::evaluate_requests(norms, order);
  for (std::size_t i = 0; i < kCount; ++i) {
    assemble(norms[i], requests[i].body->half_axes_, *requests[i].n, order, *requests[i].jet);
  }
}

// Evaluates first the inner norms of x and y, then the outer norms of the inner norm ("x") and z ("y").
template <std::size_t kCount>
void SuperellipsoidBatch::evaluate_by_two_norms(const std::array<Request, kCount>& requests, Order order) {
  std::array<PowerNormRequest, kCount> inner, outer;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Superellipsoid& body = *requests[i].body;
    const Vector3 scaled = body.half_axes_.cwiseProduct(*requests[i].n).cwiseAbs();
    inner[i] = {&body.norms_->inner_support, scaled.x(), scaled.y(), {}};
    outer[i] = {&body.norms_->outer_support, 0, scaled.z(), {}};
  }
  PowerNorm::evaluate_requests(inner, order);
  for (std::size_t i = 0; i < kCount; ++i) outer[i].x = inner[i].jet.value;
  PowerNorm::evaluate_requests(outer, order);
  for (std::size_t i = 0; i < kCount; ++i) {
    assemble(inner[i].jet, outer[i].jet, requests[i].body->half_axes_, *requests[i].n, order, *requests[i].jet);
  }
}

template <std::size_t kCount>
void SuperellipsoidBatch::evaluate(const std::array<Request, kCount>& requests, Order order) {
  const auto is_one_norm = [](const Request& request) { return is_one_norm_at(*request.body, *request.n); };
  const auto one_norms = static_cast<std::size_t>(std::ranges::count_if(requests, is_one_norm));
  if (one_norms == kCount) {
    evaluate_by_one_norm(requests, order);
  } else if (one_norms == 0) {
    evaluate_by_two_norms(requests, order);
  } else {  // the digits of a body must not depend on the other bodies
    for (const Request& request : requests) evaluate(std::array<Request, 1>{request}, order);
  }
}

template void SuperellipsoidBatch::evaluate(const std::array<Request, 2>& requests, Order order);

void Superellipsoid::evaluate(const Vector3& n, Order order, Jet& jet) const {
  SuperellipsoidBatch::evaluate(std::array<SuperellipsoidBatch::Request, 1>{{{this, &n, &jet}}}, order);
}

Vector3 Superellipsoid::advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const {
  // Each of the two norms moves separately. A flat norm (exponent above 2) moves through the boundary point. A sharp norm moves
  // through the normal, unless the section's normal rotates far.
  Vector3 moved = n + dn;
  const bool inner_is_flat = delta_ > 2;
  const bool outer_is_flat = epsilon_ > 2;
  if (!inner_is_flat && !outer_is_flat) return moved;

  const Vector3 target = jet.r + jet.H * dn;
  const Vector3 gauge_point = target.cwiseQuotient(half_axes_).cwiseAbs();
  if (delta_ == epsilon_) return along_gauge_gradient(norms_->inner_gauge, half_axes_, gauge_point, target);
  const Vector3 scaled = half_axes_.cwiseProduct(moved).cwiseAbs();
  PowerNormJet inner, outer;
  norms_->inner_gauge.gradient(gauge_point.x(), gauge_point.y(), inner);
  Vector3 result;  // scaled by the half-axes, in the first octant
  norms_->outer_gauge.gradient(inner.value, gauge_point.z(), outer);
  result.z() = outer.dy;
  if (!outer_is_flat) {
    // A flat inner norm only rotates the normal about the axis. Near the pole this moves the point less far. There the outer norm
    // moves through the point as well.
    const double across = norms_->inner_support.value(scaled.x(), scaled.y());
    if (across * outer.dy >= outer.dx * scaled.z()) {
      outer.dx = across;
      result.z() = scaled.z();
    }
  }
  const bool goes_with_point =
      inner_is_flat || rotates_far(half_axes_.cwiseProduct(n).head<2>(), half_axes_.cwiseProduct(moved).head<2>());
  if (goes_with_point) {
    result.head<2>() = outer.dx * Eigen::Vector2d(inner.dx, inner.dy);
  } else {
    const double norm = norms_->inner_support.value(scaled.x(), scaled.y());
    result.head<2>() = norm > 0 ? Eigen::Vector2d(scaled.head<2>() * (outer.dx / norm)) : Eigen::Vector2d(Eigen::Vector2d::Zero());
  }
  const Vector3& sign_xy = goes_with_point ? target : moved;
  const Vector3& sign_z = outer_is_flat ? target : moved;
  return Vector3(std::copysign(result.x(), sign_xy.x()), std::copysign(result.y(), sign_xy.y()),
                 std::copysign(result.z(), sign_z.z()))
      .cwiseQuotient(half_axes_);
}

bool Superellipsoid::surely_contains(const Vector3& point) const {
  const Vector3 gauge_point = point.cwiseQuotient(half_axes_).cwiseAbs();
  return norms_->outer_gauge.value(norms_->inner_gauge.value(gauge_point.x(), gauge_point.y()), gauge_point.z()) <= 1;
}

double Superellipsoid::min_curvature_radius_estimate() const {
  const double smallest = half_axes_.minCoeff();
  return smallest * (smallest / half_axes_.maxCoeff()) * std::min(relative_radius(delta_), relative_radius(epsilon_));
}

void Superellipsoid::add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const {
  add_half_axes_gradient(half_axes_, n, r, gradient);
  const Vector3 parts = n.cwiseProduct(r).cwiseMax(0);  // m; their sum is h
  const double across = parts.x() + parts.y();
  gradient.add("delta", across * entropy(parts.x(), parts.y()) / (delta_ * delta_));
  gradient.add("epsilon", (across + parts.z()) * entropy(across, parts.z()) / (epsilon_ * epsilon_));
}

}  // namespace supernormal
