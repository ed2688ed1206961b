// Let N(s) = |(a X nx, b Y ny)|_p be the width of the section at height s = z/c in the direction (nx, ny), before the meridian w(s)
// = (1 - |s|^epsilon)^(1/epsilon) scales it. Then
//     h(n) = max over s of w(s) N(s) + c nz s,
// a maximum of a concave function. It is where the tangent of the meridian has the slope v/t with
//     F = v N(s) - t (w(s) N'(s) + c nz) = 0.
// The unknown is the pair (t, v): s and w are the gradient of the dual norm at (t, v), which is smooth where the meridian is flat
// and where it is steep. One of t and v is 1, and the other at most 1 in magnitude. So both keep their relative precision down to
// the axes.
#include "supernormal/shapes/superovoid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/validation.hpp"
#include "shapes/lanes/powers.hpp"
#include "shapes/nested_norms.hpp"
#include "shapes/superovoid_convexity.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal {
namespace {

// Newton takes four to nine evaluations. Bisection takes over where the second derivative vanishes, at the limit of convexity.
constexpr int kMaxIterations = 200;

// Relative to the usual size of the second derivative. At the limit of convexity it vanishes at one height, and rounding decides
// its sign. It is kept above this bound.
constexpr double kLeastSlope = 1e-15;

constexpr double kRounding = std::numeric_limits<double>::epsilon();
constexpr double kDenormal = std::numeric_limits<double>::min();  // smaller numbers lose digits

/// The width N and its derivatives with respect to the height s.
class Width {
 public:
  Width(const Vector3& half_axes, double taper_x, double taper_y, const PowerNorm& norm, const Vector3& n)
      : norm_(norm), taper_x_(taper_x), taper_y_(taper_y), is_similar_(taper_x == taper_y) {
    full_x_ = half_axes.x() * std::abs(n.x());
    full_y_ = half_axes.y() * std::abs(n.y());
    if (is_similar_) full_ = norm_.value(full_x_, full_y_);
  }

  void move_to(double s) {
    X = 1 + taper_x_ * s;
    Y = 1 + taper_y_ * s;
    if (is_similar_) {
      value = full_ * X;
      slope = full_ * taper_x_;
    } else {
      norm_.curvature(full_x_ * X, full_y_ * Y, jet);
      value = jet.value;
      slope = full_x_ * taper_x_ * jet.dx + full_y_ * taper_y_ * jet.dy;
      bend = -jet.xy * (full_x_ * X) * share(full_y_ * Y) * (difference() * difference());
    }
  }

  /// Computes the norm's derivatives at the present height. Before this call `jet` may be empty.
  void complete(Order order) {
    if (order == Order::Value || !is_similar_) return;
    if (order == Order::Point) {
      norm_.gradient(full_x_ * X, full_y_ * Y, jet);
    } else {
      norm_.curvature(full_x_ * X, full_y_ * Y, jet);
    }
  }

  /// The derivatives of N' with respect to a|nx| and b|ny|.
  Eigen::Vector2d slope_gradient() const {
    const double mixed = difference() * jet.xy;
    return {taper_x_ * jet.dx - X * mixed * share(full_y_ * Y), taper_y_ * jet.dy + Y * mixed * share(full_x_ * X)};
  }

  double X = 1, Y = 1;  ///< scale of the section at the present height
  double value = 0, slope = 0, bend = 0;
  PowerNormJet jet;

 private:
  double share(double side) const { return value > 0 ? side / value : 1; }
  double difference() const { return is_similar_ ? 0 : taper_x_ / X - taper_y_ / Y; }

  const PowerNorm& norm_;
  double taper_x_, taper_y_;
  bool is_similar_;
  double full_x_, full_y_;  // a|nx|, b|ny|
  double full_ = 0;         // their norm
};

/// The solution of F = 0 for c nz >= 0, and the quantities there.
struct Summit {
  double t = 1, v = 0;
  double w = 0, s = 0;
  double climb = 0;  // w N'(s) + c nz
  double slope = 0;  // dF/dv where t = 1, -dF/dt where v = 1; positive
  PowerNormJet meridian;
};

class SummitSearch {
 public:
  /// `rise` is c nz (m); `knee` is the height s where t = v.
  SummitSearch(const PowerNorm& norm, Width& width, double rise, double knee) : norm_(norm), width_(width), rise_(rise) {
    width_.move_to(knee);
    is_steep_ = width_.value - knee * width_.slope <= rise;
  }

  Summit find() {
    // `low` and `high` bracket x, which is t near the poles and v elsewhere.
    double low = is_steep_ ? 0 : -1, high = 1;
    double x = first_guess();
    for (int i = 0; i < kMaxIterations; ++i) {
      const double value = evaluate(x);
      const double scale = std::abs(summit_.v) * width_.value + summit_.t * (summit_.w * std::abs(width_.slope) + rise_);
      if (std::abs(value) <= kRounding * scale + kDenormal) break;
      (value < 0 ? low : high) = x;
      // If everything has underflowed there is no slope, and the interval is bisected.
      double next = summit_.slope > 0 ? x - value / summit_.slope : high;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (next == x || next == low || next == high) break;
      x = next;
    }
    return summit_;
  }

 private:
  double first_guess() {
    width_.move_to(is_steep_ ? 1 : 0);
    if (is_steep_) return width_.value < rise_ ? width_.value / rise_ : 1;
    return width_.value > 0 ? std::clamp((rise_ + width_.slope) / width_.value, -1.0, 1.0) : 0;
  }

  /// F at x, or -F where F decreases with x.
  double evaluate(double x) {
    Summit& m = summit_;
    m.t = is_steep_ ? x : 1;
    m.v = is_steep_ ? 1 : x;
    norm_.curvature(m.t, std::abs(m.v), m.meridian);
    m.w = m.meridian.dx;
    m.s = std::copysign(m.meridian.dy, m.v);
    width_.move_to(m.s);
    m.climb = m.w * width_.slope + rise_;
    const double coupling = 2 * m.v * width_.slope - m.t * m.w * width_.bend;
    const double straight = is_steep_ ? m.climb : width_.value;
    const double bent = (is_steep_ ? -m.meridian.xy : m.meridian.yy) / m.meridian.value * coupling;
    m.slope = std::max(straight + bent, kLeastSlope * straight);
    const double F = m.v * width_.value - m.t * m.climb;
    return is_steep_ ? -F : F;
  }

  const PowerNorm& norm_;
  Width& width_;
  double rise_;
  bool is_steep_;
  Summit summit_;
};

}  // namespace

Superovoid::Superovoid(const Vector3& half_axes, double delta, double epsilon, double taper_x, double taper_y)
    : half_axes_(require_half_axes(half_axes)),
      delta_(require_in("delta", delta, kMinExponent, kMaxExponent)),
      epsilon_(require_in("epsilon", epsilon, kMinExponent, kMaxExponent)),
      taper_x_(taper_x),
      taper_y_(taper_y),
      knee_(power(Real<1>(2), Real<1>(-1 / epsilon)).v),
      norms_(std::make_shared<const NestedNorms>(delta, epsilon)) {
  require_convex_taper(delta, epsilon, taper_x, taper_y);
  half_extents_ = {support(Vector3::UnitX()), support(Vector3::UnitY()), half_axes_.z()};
  // Where the section is scaled by `narrowest`, the radius of curvature of its meridian is scaled by the square.
  const double narrowest = 1 - std::max(std::abs(taper_x_), std::abs(taper_y_));
  min_curvature_radius_ = Superellipsoid(half_axes_, delta_, epsilon_).min_curvature_radius_estimate() * narrowest * narrowest;
}

double Superovoid::max_taper(double epsilon) {
  return largest_convex_taper(require_in("epsilon", epsilon, kMinExponent, kMaxExponent));
}

ShapeTraits Superovoid::traits() const { return {.has_hessian = true, .has_flat_faces = delta_ > 2 || epsilon_ > 2}; }

void Superovoid::evaluate(const Vector3& n, Order order, Jet& jet) const {
  const double up = std::copysign(1.0, n.z());  // upside down, the body has the opposite tapers
  const double rise = half_axes_.z() * std::abs(n.z());
  Width width(half_axes_, up * taper_x_, up * taper_y_, norms_->inner_support, n);
  const Summit m = SummitSearch(norms_->outer_support, width, rise, knee_).find();
  jet.h = m.w * width.value + rise * m.s;
  if (order == Order::Value) return;

  width.complete(order);
  const Vector3 axes(std::copysign(half_axes_.x(), n.x()), std::copysign(half_axes_.y(), n.y()), up * half_axes_.z());
  const PowerNormJet& norm = width.jet;
  const double X = width.X, Y = width.Y;
  jet.r = axes.cwiseProduct(Vector3(m.w * X * norm.dx, m.w * Y * norm.dy, m.s));
  if (order == Order::Point) return;

  // The Hessian has two parts: w times the Hessian of N, for a fixed height, and the part from the change of height with the
  // normal.
  const bool is_steep = m.v == 1;
  const double per_width = m.meridian.dx_over_x / m.meridian.value / (is_steep ? m.climb : width.value);  // w/N
  const double follows = (is_steep ? m.meridian.xx : m.meridian.yy) / m.meridian.value / m.slope;
  const Eigen::Vector2d slope_gradient = width.slope_gradient();
  const Vector3 pull(m.t * m.w * slope_gradient.x() - m.v * X * norm.dx, m.t * m.w * slope_gradient.y() - m.v * Y * norm.dy, m.t);
  Matrix3& H = jet.H;
  H.noalias() = pull * (follows * pull).transpose();
  H(0, 0) += per_width * X * X * norm.xx;
  H(0, 1) += per_width * X * Y * norm.xy;
  H(1, 1) += per_width * Y * Y * norm.yy;
  H(1, 0) = H(0, 1);
  H(2, 0) = H(0, 2);
  H(2, 1) = H(1, 2);
  H.array() *= (axes * axes.transpose()).array();
}

bool Superovoid::surely_contains(const Vector3& point) const {
  const Vector3 gauge_point = point.cwiseQuotient(half_axes_).cwiseAbs();
  if (!(gauge_point.z() <= 1)) return false;  // between the ends the section is positive
  const double s = point.z() / half_axes_.z();
  const double width = norms_->inner_gauge.value(gauge_point.x() / (1 + taper_x_ * s), gauge_point.y() / (1 + taper_y_ * s));
  return norms_->outer_gauge.value(width, gauge_point.z()) <= 1;
}

Vector3 Superovoid::advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const {
  // Each of the two norms moves separately, as in the Superellipsoid. A flat norm (exponent above 2) moves through the boundary
  // point. A sharp norm moves through the normal, unless the point demands a longer step.
  const Vector3 moved = n + dn;
  const bool inner_is_flat = delta_ > 2;
  const bool outer_is_flat = epsilon_ > 2;
  if (!inner_is_flat && !outer_is_flat) return moved;

  const Vector3 target = jet.r + jet.H * dn;
  const Vector3 gauge_point = target.cwiseQuotient(half_axes_);
  // A long step may leave the heights where the section is positive.
  const double s = std::clamp(gauge_point.z(), -1.0, 1.0);
  const double X = 1 + taper_x_ * s, Y = 1 + taper_y_ * s;
  PowerNormJet section, meridian;
  norms_->inner_gauge.gradient(std::abs(gauge_point.x()) / X, std::abs(gauge_point.y()) / Y, section);

  // The normal's components in the section, scaled to a dual norm of 1, and their signs.
  const Eigen::Vector2d axes(X * half_axes_.x(), Y * half_axes_.y());
  const Eigen::Vector2d scaled = axes.cwiseProduct(moved.head<2>());
  const double width = norms_->inner_support.value(std::abs(scaled.x()), std::abs(scaled.y()));
  const bool goes_with_point = inner_is_flat || rotates_far(axes.cwiseProduct(n.head<2>()), scaled);
  Eigen::Vector2d across(section.dx, section.dy);
  if (!goes_with_point) across = width > 0 ? Eigen::Vector2d(scaled.cwiseAbs() / width) : Eigen::Vector2d(Eigen::Vector2d::Zero());
  const Vector3& sign = goes_with_point ? target : moved;
  const Vector3 direction(std::copysign(across.x(), sign.x()) / axes.x(), std::copysign(across.y(), sign.y()) / axes.y(), 0);

  norms_->outer_gauge.gradient(section.value, std::abs(gauge_point.z()), meridian);
  // As a point moves up, the section grows, and the point's place relative to the section comes nearer to its middle.
  const double growth = section.value > 0 ? (section.dx * std::abs(gauge_point.x()) * taper_x_ / (X * X) +
                                             section.dy * std::abs(gauge_point.y()) * taper_y_ / (Y * Y))
                                          : 0;
  const double along = std::copysign(meridian.dy, gauge_point.z()) - meridian.dx * growth;
  const Vector3 through_point = meridian.dx * direction + Vector3(0, 0, along / half_axes_.z());
  const bool is_farther = moved.z() * along > 0 && meridian.dx * std::abs(moved.z()) > width * std::abs(through_point.z());
  return outer_is_flat || is_farther ? through_point : width * direction + Vector3(0, 0, moved.z());
}

// At the summit h does not change with the height, so the parameters act at the height of r alone (the envelope theorem).
void Superovoid::add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const {
  add_half_axes_gradient(half_axes_, n, r, gradient);
  const Vector3 parts(std::max(n.x() * r.x(), 0.0), std::max(n.y() * r.y(), 0.0), 0);  // m
  const double across = parts.x() + parts.y();                                         // w(s) N(s)
  const double s = std::clamp(r.z() / half_axes_.z(), -1.0, 1.0);
  const double X = 1 + taper_x_ * s, Y = 1 + taper_y_ * s;
  gradient.add("delta", across * entropy(parts.x(), parts.y()) / (delta_ * delta_));
  // w = (1 - |s|^epsilon)^(1/epsilon). Near an end of the body, w follows from the width and not from the height.
  const double width = norms_->inner_support.value(half_axes_.x() * X * std::abs(n.x()), half_axes_.y() * Y * std::abs(n.y()));
  const double w = across > 0 ? std::min(across / width, 1.0) : 0;
  double by_epsilon = 0;
  if (w > 0) {
    const double rest = std::pow(w, epsilon_);  // 1 - |s|^epsilon
    const double height = std::pow(std::abs(s), epsilon_);
    const double log_height = rest < 0.5 ? std::log1p(-rest) : epsilon_ * std::log(std::max(std::abs(s), kDenormal));
    by_epsilon = -across * (epsilon_ * std::log(w) + (rest > kDenormal ? height * log_height / rest : -1)) / (epsilon_ * epsilon_);
  }
  gradient.add("epsilon", by_epsilon);
  gradient.add("taper_x", parts.x() * s / X);
  gradient.add("taper_y", parts.y() * s / Y);
}

}  // namespace supernormal
