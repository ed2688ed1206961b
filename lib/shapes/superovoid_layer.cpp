// The layer that sweeping by a sphere adds to a superovoid, or to a superellipsoid if both tapers are 0.
//
// The parallel surface at distance s is r + s n, with the area element n.((r_u + s n_u) x (r_v + s n_v)). This is a polynomial in
// s, so the integral across the layer is exact (Steiner). Its three coefficients are integrated over the boundary. Let w and e be
// the angles of the section and the meridian. Then point and normal have the closed forms
//     r = (a X cos^(2/epsilon) e cos^(2/delta) w, b Y cos^(2/epsilon) e sin^(2/delta) w, c sin^(2/epsilon) e),
//     n ~ (cos^(2/q) e cos^(2/p) w / (a X), cos^(2/q) e sin^(2/p) w / (b Y), (sin^(2/q) e - g cos^2 e) / c).
// Here p and q are the dual exponents, X = 1 + taper_x z/c and Y = 1 + taper_y z/c the scales of the section, and g = taper_x/X
// cos^2 w + taper_y/Y sin^2 w its relative growth. At both ends of an octant the powers are singular, for boxes (r) and octahedra
// (n) alike. In log tan of the angles they decay exponentially. With log tan w = sinh t they decay doubly exponentially, and the
// trapezoidal rule converges exponentially (Takahasi and Mori 1974).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/mass_properties.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace supernormal {
namespace {

/// Powers of the cosine and sine of an angle, and their derivatives with respect to log tan of the angle.
struct Powers {
  double cos, sin, dcos, dsin;
};

/// A node of the rule, with the powers 2/exponent for points and 2/dual for normals. The derivatives include the node's weight.
struct LayerNode {
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

/// Nodes with the spacing `step` in t, out to where the slowest power has decayed below rounding. `log_aspect` is the logarithm of
/// the body's aspect ratio: the normals of a long body decay later by it.
std::vector<LayerNode> make_rule(double exponent, double step, double log_aspect) {
  const double dual = exponent / (exponent - 1);
  const double end = std::asinh(std::max(exponent, dual) * (20 + 0.5 * log_aspect));
  const int count = static_cast<int>(std::ceil(end / step));
  std::vector<LayerNode> rule;
  rule.reserve(2 * static_cast<std::size_t>(count) + 1);
  for (int i = -count; i <= count; ++i) {
    const double t = i * step;
    const double weight = step * std::cosh(t);
    rule.push_back({powers(exponent, std::sinh(t), weight), powers(dual, std::sinh(t), weight)});
  }
  return rule;
}

/// Volume, diagonal of the second moment, and first moment along z.
using Moments = Eigen::Matrix<double, 5, 1>;

/// The half of a body with z >= 0, or its other half upside down.
struct Half {
  Vector3 axes;
  double taper_x, taper_y;
};

/// A point of the surface, its normal, and their derivatives with respect to the two parameters. The derivatives include the nodes'
/// weights.
struct Surface {
  Vector3 r, r_w, r_e;
  Vector3 n, n_w, n_e;  // n_w and n_e may have a component along n
};

Surface surface(const Half& half, const LayerNode& w, const LayerNode& e) {
  const Vector3& axes = half.axes;
  const Eigen::Array2d taper(half.taper_x, half.taper_y);
  const Eigen::Array2d scale = 1 + taper * e.point.sin, growth = taper / scale;
  const Eigen::Array2d scale_e = taper * e.point.dsin, growth_e = -growth * growth * e.point.dsin;
  const Eigen::Array2d point(w.point.cos, w.point.sin), point_w(w.point.dcos, w.point.dsin);
  const Eigen::Array2d normal(w.normal.cos, w.normal.sin), normal_w(w.normal.dcos, w.normal.dsin);
  const Eigen::Array2d side = axes.head<2>().array() * scale;
  // cos^2 w and sin^2 w.
  const Eigen::Array2d share = point * normal, share_w = point_w * normal + point * normal_w;
  const double cos2 = e.point.cos * e.normal.cos, cos2_e = e.point.dcos * e.normal.cos + e.point.cos * e.normal.dcos;

  Surface out;
  out.r << side * point * e.point.cos, axes.z() * e.point.sin;
  out.r_w << side * point_w * e.point.cos, 0;
  out.r_e << axes.head<2>().array() * point * (scale * e.point.dcos + scale_e * e.point.cos), axes.z() * e.point.dsin;
  out.n << normal / side * e.normal.cos, (e.normal.sin - cos2 * (growth * share).sum()) / axes.z();
  out.n_w << normal_w / side * e.normal.cos, -cos2 * (growth * share_w).sum() / axes.z();
  out.n_e << normal / side * (e.normal.dcos - e.normal.cos * scale_e / scale),
      (e.normal.dsin - cos2_e * (growth * share).sum() - cos2 * (growth_e * share).sum()) / axes.z();
  const double length = out.n.norm();
  out.n /= length;
  out.n_w /= length;
  out.n_e /= length;
  return out;
}

/// The moments of the layer over one surface element, at the nodes `w` and `e`.
Moments element(const Half& half, double radius, const LayerNode& w, const LayerNode& e) {
  const Surface f = surface(half, w, e);
  const double area = f.n.dot(f.r_w.cross(f.r_e));
  const double bend = f.n.dot(f.r_w.cross(f.n_e)) + f.n.dot(f.n_w.cross(f.r_e));
  const double angle = f.n.dot(f.n_w.cross(f.n_e));
  // moment(k) is the integral of s^k (area + bend s + angle s^2) from 0 to radius.
  const auto moment = [&](int k) {
    return std::pow(radius, k + 1) * (area / (k + 1) + radius * (bend / (k + 2) + radius * (angle / (k + 3))));
  };
  Moments sum;
  sum[0] = moment(0);
  sum.segment<3>(1) = f.r.cwiseAbs2() * moment(0) + 2 * f.r.cwiseProduct(f.n) * moment(1) + f.n.cwiseAbs2() * moment(2);
  sum[4] = f.r.z() * moment(0) + f.n.z() * moment(1);
  return sum;
}

/// The moments over half of the boundary: four times one octant.
Moments integrate(const Half& half, double radius, const std::vector<LayerNode>& section, const std::vector<LayerNode>& meridian) {
  Moments total = Moments::Zero();
  for (const LayerNode& e : meridian) {
    Moments row = Moments::Zero();
    for (const LayerNode& w : section) row += element(half, radius, w, e);
    total += row;
  }
  return 4 * total;
}

/// The moments over the whole boundary.
Moments integrate(const Superovoid& core, double radius, double step) {
  const Vector3& axes = core.half_axes();
  const double log_aspect = std::log(axes.maxCoeff() / axes.minCoeff());
  const std::vector<LayerNode> section = make_rule(core.delta(), step, log_aspect);
  const std::vector<LayerNode> meridian = make_rule(core.epsilon(), step, log_aspect);
  const Moments upper = integrate({axes, core.taper_x(), core.taper_y()}, radius, section, meridian);
  const bool is_symmetric = core.taper_x() == 0 && core.taper_y() == 0;
  Moments lower = is_symmetric ? upper : integrate({axes, -core.taper_x(), -core.taper_y()}, radius, section, meridian);
  lower[4] = -lower[4];
  return upper + lower;
}

}  // namespace

MassProperties superovoid_layer(const Superovoid& core, double radius) {
  constexpr double kTolerance = 1e-11;
  constexpr double kFinestStep = 1.0 / 64;

  Moments sum = Moments::Zero();
  double change = 1;
  for (double step = 0.25; change > kTolerance && step >= kFinestStep; step /= 2) {
    const Moments finer = integrate(core, radius, step);
    Moments size = finer;
    size[4] = std::sqrt(finer[0] * finer[3]);
    change = ((finer - sum).array() / size.array()).abs().maxCoeff();
    sum = finer;
  }
  MassProperties layer;
  layer.volume = sum[0];
  layer.centroid.z() = sum[4] / sum[0];
  layer.second_moment = sum.segment<3>(1).asDiagonal();
  layer.relative_error = change;
  return layer;
}

}  // namespace supernormal
