#include "body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <supernormal/shapes/ellipsoid.hpp>
#include <supernormal/shapes/superellipsoid.hpp>
#include <supernormal/shapes/superovoid.hpp>

namespace fit {
namespace {

/// -x ln x - (1-x) ln(1-x) for x = part / (part + rest).
double entropy(double part, double rest) {
  const double whole = part + rest;
  if (!(part > 0) || !(rest > 0)) return 0;
  return -(part / whole) * std::log(part / whole) - (rest / whole) * std::log(rest / whole);
}

Matrix3 axes_of(const Vector3& x, const Vector3& y, const Vector3& z) {
  Matrix3 axes;
  axes << x, y, z;
  return axes;
}

}  // namespace

const char* name_of(Family family) {
  constexpr std::array kNames = {"ellipsoid", "superellipsoid", "superovoid"};
  return kNames[static_cast<std::size_t>(family)];
}

int parameter_count(Family family) {
  constexpr std::array kCounts = {9, 11, 12};
  return kCounts[static_cast<std::size_t>(family)];
}

std::unique_ptr<supernormal::Shape> make_shape(const Body& body) {
  switch (body.family) {
    case Family::Ellipsoid:
      return std::make_unique<supernormal::Ellipsoid>(body.half_axes);
    case Family::Superellipsoid:
      return std::make_unique<supernormal::Superellipsoid>(body.half_axes, body.delta, body.epsilon);
    case Family::Superovoid:
      break;
  }
  return std::make_unique<supernormal::Superovoid>(body.half_axes, body.delta, body.epsilon, body.taper, body.taper);
}

Body with_axes(const Body& body, const Matrix3& axes) {
  Body turned = body;
  turned.orientation = Eigen::Quaterniond(body.rotation() * axes);
  turned.orientation.normalize();
  turned.half_axes = axes.transpose().cwiseAbs() * body.half_axes;
  return turned;
}

Body in_customary_order(const Body& body) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  Body ordered = body;
  if (ordered.family == Family::Ellipsoid) {
    std::array<int, 3> order = {0, 1, 2};
    std::ranges::stable_sort(order, [&](int i, int j) { return body.half_axes[i] > body.half_axes[j]; });
    const Vector3 first = Vector3::Unit(order[0]), second = Vector3::Unit(order[1]);
    return with_axes(ordered, axes_of(first, second, first.cross(second)));
  }
  if (ordered.taper > 0) {
    ordered = with_axes(ordered, axes_of(x, -y, -z));
    ordered.taper = -ordered.taper;
  }
  if (ordered.half_axes.y() > ordered.half_axes.x()) ordered = with_axes(ordered, axes_of(y, -x, z));
  return ordered;
}

Body moved(const Body& body, double scale, const Vector3& offset) {
  Body result = body;
  result.position = scale * body.position + offset;
  result.half_axes = scale * body.half_axes;
  return result;
}

Gradient support_gradient(const Body& body, const Vector3& n, const Vector3& r) {
  Gradient gradient = Gradient::Zero();
  const Vector3 share = n.cwiseProduct(r).cwiseMax(0.0);
  gradient.segment<3>(kLogAxes) = n.cwiseProduct(r);
  if (body.family == Family::Ellipsoid) return gradient;

  const double section = share.x() + share.y();
  const double delta = body.delta, epsilon = body.epsilon;
  gradient[kLogDelta] = (delta - 1) / (delta * delta) * section * entropy(share.x(), share.y());

  // Without the taper the section shrinks with the height zeta as (1 - zeta^epsilon)^(1/epsilon).
  const double zeta = std::clamp(r.z() / body.half_axes.z(), -1.0, 1.0);
  const double height = std::pow(std::abs(zeta), epsilon);
  if (height < 1)
    gradient[kLogEpsilon] = (epsilon - 1) / (epsilon * epsilon) * section * entropy(height, 1 - height) / (1 - height);
  gradient[kTaper] = section * zeta / (1 + body.taper * zeta);
  return gradient;
}

Vector3 boundary_point(const Body& body, const Vector3& u, PointDerivatives* derivatives) {
  // The gauge of u is G = (L^epsilon + z^epsilon)^(1/epsilon) with the gauge L = (x^delta + y^delta)^(1/delta) of the section.
  // Powers of ratios cannot overflow.
  const double delta = body.delta, epsilon = body.epsilon;
  const Vector3 size = u.cwiseAbs();
  const double wide = std::max(size.x(), size.y()), narrow = std::min(size.x(), size.y());
  const double ratio = wide > 0 ? std::pow(narrow / wide, delta) : 0;
  const double section = wide * std::pow(1 + ratio, 1 / delta);
  const double larger = std::max(section, size.z());
  const double flat = std::pow(section / larger, epsilon), high = std::pow(size.z() / larger, epsilon);
  const double gauge = larger * std::pow(flat + high, 1 / epsilon);
  const double zeta = u.z() / gauge, width = 1 + body.taper * zeta;
  const Vector3 s = u / gauge;
  const Vector3 r = body.half_axes.cwiseProduct(Vector3(s.x() * width, s.y() * width, s.z()));
  if (derivatives == nullptr) return r;
  // The derivatives of ln L and ln G by the exponents are negative entropies of the shares of their terms.
  const double by_delta = -entropy(1, ratio) / (delta * delta) * flat / (flat + high);
  const double by_epsilon = -entropy(flat, high) / (epsilon * epsilon);
  const Vector3 by_log_gauge = -r - body.half_axes.cwiseProduct(Vector3(s.x(), s.y(), 0)) * (body.taper * zeta);
  derivatives->setZero();
  for (int i = 0; i < 3; ++i) (*derivatives)(i, kLogAxes + i) = r[i];
  derivatives->col(kLogDelta) = (delta - 1) * by_delta * by_log_gauge;
  derivatives->col(kLogEpsilon) = (epsilon - 1) * by_epsilon * by_log_gauge;
  derivatives->col(kTaper) = body.half_axes.cwiseProduct(Vector3(s.x(), s.y(), 0)) * zeta;
  return r;
}

std::array<bool, kParameters> fixed_parameters(const ShapeLimits& limits) {
  std::array<bool, kParameters> is_fixed{};
  is_fixed[kLogAxes + 1] = limits.has_round_section;
  is_fixed[kLogDelta] = limits.has_round_section || limits.delta;
  is_fixed[kLogEpsilon] = limits.epsilon.has_value();
  return is_fixed;
}

double taper_limit(double epsilon) {
  // Slightly below the limit, because of rounding.
  return (1 - 1e-9) * supernormal::Superovoid::max_taper(epsilon);
}

double taper_limit_slope(double epsilon) {
  return taper_limit(epsilon) * (1 - (epsilon - 1) * (std::numbers::ln2 / (epsilon * epsilon) + 1 / epsilon));
}

}  // namespace fit
