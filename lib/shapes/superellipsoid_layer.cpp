// The layer that a sphere adds to a superellipsoid when it sweeps it.
//
// The parallel surface at distance s is r + s n with the area element n.((r_u + s n_u) x (r_v + s n_v)): a polynomial in s, so the
// integral across the layer is exact (Steiner), and the three coefficients have to be integrated over the boundary. With angles
// w, e of the section and the meridian,
//     r = (a cos^(2/epsilon) e cos^(2/delta) w, b cos^(2/epsilon) e sin^(2/delta) w, c sin^(2/epsilon) e),
//     n ~ (cos^(2/q) e cos^(2/p) w / a, cos^(2/q) e sin^(2/p) w / b, sin^(2/q) e / c)
// with the dual exponents p, q: point and normal in closed form. The powers are singular at both ends of an octant for boxes (r)
// and octahedra (n) alike. In log tan of the angles they decay exponentially; log tan w = sinh t makes that doubly exponential, for
// which the trapezoidal rule converges exponentially (Takahasi and Mori 1974). All terms are positive: nothing cancels.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/mass_properties.hpp"

namespace supernormal {
namespace {

/// A power of cosine and sine of an angle and their derivatives by log tan of the angle.
struct Powers {
  double cos, sin, dcos, dsin;
};

/// One node of the rule: the powers 2/exponent for points, 2/dual for normals; the derivatives carry the weight of the node.
struct Node {
  Powers point, normal;
};

Powers powers(double exponent, double log_tan, double weight) {
  const double small = std::log1p(std::exp(-2 * std::abs(log_tan)));
  const double log_cos2 = -(std::max(2 * log_tan, 0.0) + small);
  const double log_sin2 = -(std::max(-2 * log_tan, 0.0) + small);
  const double cos = std::exp(log_cos2 / exponent);
  const double sin = std::exp(log_sin2 / exponent);
  const double slope = weight * 2 / exponent;
  return {cos, sin, -slope * std::exp(log_sin2) * cos, slope * std::exp(log_cos2) * sin};
}

/// Nodes `step` apart in t, out to where the slowest power has decayed below rounding. `log_aspect`: how much later that is for
/// normals of a body that much longer than wide.
std::vector<Node> make_rule(double exponent, double step, double log_aspect) {
  const double dual = exponent / (exponent - 1);
  const double end = std::asinh(std::max(exponent, dual) * (20 + 0.5 * log_aspect));
  const int count = static_cast<int>(std::ceil(end / step));
  std::vector<Node> rule;
  rule.reserve(2 * static_cast<std::size_t>(count) + 1);
  for (int i = -count; i <= count; ++i) {
    const double t = i * step;
    const double weight = step * std::cosh(t);
    rule.push_back({powers(exponent, std::sinh(t), weight), powers(dual, std::sinh(t), weight)});
  }
  return rule;
}

/// Volume and diagonal of the second moment of the layer over one surface element, spanned by the nodes `w` and `e`.
Eigen::Vector4d element(const Vector3& axes, double radius, const Node& w, const Node& e) {
  const Vector3 r(axes.x() * e.point.cos * w.point.cos, axes.y() * e.point.cos * w.point.sin, axes.z() * e.point.sin);
  const Vector3 r_w(axes.x() * e.point.cos * w.point.dcos, axes.y() * e.point.cos * w.point.dsin, 0);
  const Vector3 r_e(axes.x() * e.point.dcos * w.point.cos, axes.y() * e.point.dcos * w.point.sin, axes.z() * e.point.dsin);

  const Vector3 normal = Vector3(e.normal.cos * w.normal.cos, e.normal.cos * w.normal.sin, e.normal.sin).cwiseQuotient(axes);
  const double scale = 1 / normal.norm();
  const Vector3 n = scale * normal;
  // The parts of n_w and n_e along n drop out of the products below.
  const Vector3 n_w = scale * Vector3(e.normal.cos * w.normal.dcos / axes.x(), e.normal.cos * w.normal.dsin / axes.y(), 0);
  const Vector3 n_e =
      scale * Vector3(e.normal.dcos * w.normal.cos / axes.x(), e.normal.dcos * w.normal.sin / axes.y(), e.normal.dsin / axes.z());

  const double area = n.dot(r_w.cross(r_e));
  const double bend = n.dot(r_w.cross(n_e)) + n.dot(n_w.cross(r_e));
  const double angle = n.dot(n_w.cross(n_e));
  // moment(k): integral of s^k (area + bend s + angle s^2) from 0 to radius.
  const auto moment = [&](int k) {
    return std::pow(radius, k + 1) * (area / (k + 1) + radius * (bend / (k + 2) + radius * (angle / (k + 3))));
  };
  Eigen::Vector4d sum;
  sum[0] = moment(0);
  sum.tail<3>() = r.cwiseAbs2() * moment(0) + 2 * r.cwiseProduct(n) * moment(1) + n.cwiseAbs2() * moment(2);
  return sum;
}

/// Over the whole boundary: eight times one octant.
Eigen::Vector4d integrate(const Vector3& axes, double radius, const std::vector<Node>& section, const std::vector<Node>& meridian) {
  Eigen::Vector4d total = Eigen::Vector4d::Zero();
  for (const Node& e : meridian) {
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    for (const Node& w : section) row += element(axes, radius, w, e);
    total += row;
  }
  return 8 * total;
}

}  // namespace

MassProperties superellipsoid_layer(const Vector3& half_axes, double delta, double epsilon, double radius) {
  constexpr double kTolerance = 1e-11;
  constexpr std::size_t kMaxNodes = 2048;  // in each direction
  const double log_aspect = std::log(half_axes.maxCoeff() / half_axes.minCoeff());

  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  double change = 1;
  for (double step = 0.25; change > kTolerance; step /= 2) {
    const std::vector<Node> section = make_rule(delta, step, log_aspect);
    const std::vector<Node> meridian = make_rule(epsilon, step, log_aspect);
    if (std::max(section.size(), meridian.size()) > kMaxNodes) break;
    const Eigen::Vector4d finer = integrate(half_axes, radius, section, meridian);
    change = ((finer - sum).array() / finer.array()).abs().maxCoeff();
    sum = finer;
  }
  MassProperties layer;
  layer.volume = sum[0];
  layer.second_moment = sum.tail<3>().asDiagonal();
  layer.relative_error = change;
  return layer;
}

}  // namespace supernormal
