// Support function, boundary point and Hessian of superellipsoids in lanes (supernormal/shapes/superellipsoid.hpp).
#pragma once

#include "shapes/lanes/powers.hpp"
#include "shapes/lanes/vectors.hpp"
#include "supernormal/shapes/lane_body.hpp"

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): real.hpp

// For p < 2 the second derivative is unbounded as k -> 0 (a flat face). Below this ratio it stays constant. That value exceeds any
// relevant radius of curvature, and a product of two such numbers is still in range. Below the least ratio the power is constant as
// well: the logarithm takes normal numbers.
constexpr double kLanesFlatRatio = 1e-60;
constexpr double kLanesLeastRatio = 1e-300;

// Stands for the infinite curvature of an edge. It is beyond limits::kLargestCurvature, so that nothing is computed with it, and a
// product of such numbers is still in range.
constexpr double kLanesSharp = 1e40;

/// A norm (x^p + y^p)^(1/p) of two numbers.
template <typename T>
struct NormExponents {
  T power_1;  ///< p - 1
  T inverse;  ///< 1/p
};

/// Two numbers that are not negative, by the larger and their ratio.
template <typename T>
struct Ratio {
  typename T::Mask x_is_larger;
  T larger, k, power_1;  // k = smaller/larger; power_1 = k^(p-1)
};

/// k^e of a ratio in [0, 1], for e > 0.
template <typename T>
SUPERNORMAL_INLINE T ratio_power(T k, T e) {
  return select(T(0.0) < k, power(max(k, T(kLanesLeastRatio)), e), T(0.0));
}

/// The ratio without its power.
template <typename T>
SUPERNORMAL_INLINE Ratio<T> ratio_of(T x, T y) {
  Ratio<T> out;
  out.x_is_larger = y < x;
  out.larger = max(x, y);
  // At the origin the direction is undefined. The values are then the values for x = y.
  const auto is_positive = T(0.0) < out.larger;
  out.k = select(is_positive, min(x, y), T(1.0)) / select(is_positive, out.larger, T(1.0));
  return out;
}

template <typename T>
SUPERNORMAL_INLINE Ratio<T> ratio_of(T x, T y, T p_minus_1) {
  Ratio<T> out = ratio_of(x, y);
  out.power_1 = ratio_power(out.k, p_minus_1);
  return out;
}

/// A norm and its first derivatives, with what the second derivatives need.
template <typename T>
struct NormJet {
  Ratio<T> ratio;
  T value, dx, dy;
  T root, d_larger;
};

/// `sum` is 1 + k^p, and `root` is sum^(1/p).
template <typename T>
SUPERNORMAL_INLINE NormJet<T> norm_from(const Ratio<T>& ratio, T sum, T root) {
  NormJet<T> out;
  out.ratio = ratio;
  out.root = root;
  out.value = ratio.larger * root;
  out.d_larger = root / sum;
  const T d_smaller = out.d_larger * ratio.power_1;
  out.dx = select(ratio.x_is_larger, out.d_larger, d_smaller);
  out.dy = select(ratio.x_is_larger, d_smaller, out.d_larger);
  return out;
}

template <typename T>
SUPERNORMAL_INLINE NormJet<T> norm_jet(T x, T y, const NormExponents<T>& p) {
  const Ratio<T> ratio = ratio_of(x, y, p.power_1);
  const T sum = ratio.power_1 * ratio.k + 1.0;
  return norm_from(ratio, sum, root(sum, p.inverse));
}

/// The value alone.
template <typename T>
SUPERNORMAL_INLINE T norm_value(T x, T y, const NormExponents<T>& p) {
  const Ratio<T> ratio = ratio_of(x, y, p.power_1);
  return ratio.larger * root(ratio.power_1 * ratio.k + 1.0, p.inverse);
}

/// k^(p-2) at the ratio below which it stays constant.
SUPERNORMAL_INLINE double flat_power(double p_minus_1) { return power(Real<1>(kLanesFlatRatio), Real<1>(p_minus_1 - 1)).v; }

/// The second derivatives times the value, and value * dx / x.
template <typename T>
struct NormBends {
  T xx, xy, yy, dx_over_x;
};

/// `flat` is kFlatRatio^(p-2).
template <typename T>
SUPERNORMAL_INLINE NormBends<T> norm_bends(const NormJet<T>& norm, const NormExponents<T>& p, T flat) {
  const Ratio<T>& ratio = norm.ratio;
  const auto is_plain = T(kLanesFlatRatio) < ratio.k;
  const T power_2 = select(is_plain, ratio.power_1 / select(is_plain, ratio.k, T(1.0)), flat);
  const T scale = p.power_1 * norm.d_larger * norm.d_larger;
  const T small = scale * ratio.power_1 * ratio.k, large = scale * power_2;
  return {select(ratio.x_is_larger, small, large), -(scale * ratio.power_1), select(ratio.x_is_larger, large, small),
          norm.d_larger * norm.root * select(ratio.x_is_larger, T(1.0), power_2)};
}

/// The derivatives of a function that is constant on the boundary, at a point near it: the normal's direction, and how it changes.
template <typename T>
struct LevelJet {
  Vec<T> gradient;
  Sym<T> second;  // without xz and yz, which are 0
};

/// For a superellipsoid |rho|^epsilon + |z/c|^epsilon with the inner norm rho, over epsilon and the larger of the two to the power
/// epsilon - 1. So the outer norm takes no root. `inverse`: 1/half-axes.
template <typename T>
SUPERNORMAL_INLINE LevelJet<T> level_jet(Vec<T> inverse, const NormExponents<T>& delta, T epsilon_minus_1, Vec<T> point) {
  const auto at_zero = [](T power_1) {  // k^(p-2) for k = 0
    return select(T(1.0) < power_1, T(0.0), select(power_1 < T(1.0), T(kLanesSharp), T(1.0)));
  };
  const NormJet<T> rho = norm_jet(abs(point.x * inverse.x), abs(point.y * inverse.y), delta);
  const Ratio<T> outer = ratio_of(rho.value, abs(point.z * inverse.z), epsilon_minus_1);
  const auto is_plain = T(kLanesFlatRatio) < outer.k;
  const T power_2 = select(is_plain, outer.power_1 / select(is_plain, outer.k, T(1.0)), at_zero(epsilon_minus_1));
  const Vec<T> axes = {with_sign(inverse.x, point.x), with_sign(inverse.y, point.y), with_sign(inverse.z, point.z)};
  const T slope = select(outer.x_is_larger, T(1.0), outer.power_1);
  LevelJet<T> out;
  const T x = axes.x * rho.dx, y = axes.y * rho.dy;
  out.gradient = {x * slope, y * slope, axes.z * select(outer.x_is_larger, outer.power_1, T(1.0))};
  // The second derivatives of rho are bends / rho, and slope / rho is this power over the larger.
  const NormBends<T> bends = norm_bends(rho, delta, at_zero(delta.power_1));
  const T inverse_larger = T(1.0) / select(T(0.0) < outer.larger, outer.larger, T(1.0));
  const T across = select(outer.x_is_larger, T(1.0), power_2) * inverse_larger;
  const T along = select(outer.x_is_larger, power_2, T(1.0)) * inverse_larger;
  out.second = {across * (epsilon_minus_1 * x * x + bends.xx * (axes.x * axes.x)),
                across * (epsilon_minus_1 * y * y + bends.yy * (axes.y * axes.y)),
                along * epsilon_minus_1 * (axes.z * axes.z),
                across * (epsilon_minus_1 * x * y + bends.xy * (axes.x * axes.y)),
                T(0.0),
                T(0.0)};
  return out;
}

/// The numbers of a body that an evaluation needs.
template <typename T>
struct PowerBody {
  Vec<T> half;  ///< m
  NormExponents<T> inner, outer;
};

/// The same body in all lanes.
template <typename T>
SUPERNORMAL_INLINE PowerBody<T> power_body(const LaneBody& body) {
  return {{T(body.half[0]), T(body.half[1]), T(body.half[2])},
          {T(body.p_minus_1), T(body.inverse_p)},
          {T(body.q_minus_1), T(body.inverse_q)}};
}

/// A jet up to the boundary point, with what the Hessian needs.
template <typename T>
struct PointJet {
  T h;       // m
  Vec<T> r;  // m
  Vec<T> signed_axes;
  NormJet<T> inner, outer;
};

template <typename T>
SUPERNORMAL_INLINE PointJet<T> point_jet(const PowerBody<T>& body, Vec<T> n) {
  PointJet<T> out;
  out.inner = norm_jet(abs(body.half.x * n.x), abs(body.half.y * n.y), body.inner);
  out.outer = norm_jet(out.inner.value, abs(body.half.z * n.z), body.outer);
  out.h = out.outer.value;
  out.signed_axes = {with_sign(body.half.x, n.x), with_sign(body.half.y, n.y), with_sign(body.half.z, n.z)};
  out.r = {out.signed_axes.x * (out.outer.dx * out.inner.dx), out.signed_axes.y * (out.outer.dx * out.inner.dy),
           out.signed_axes.z * out.outer.dy};
  return out;
}

/// The Hessian, by the chain rule: the inner second derivatives are bends / t, and dx / t stays finite at the pole t = 0.
template <typename T>
SUPERNORMAL_INLINE Sym<T> hessian(const PowerBody<T>& body, const PointJet<T>& jet, T inner_flat, T outer_flat) {
  const NormBends<T> in = norm_bends(jet.inner, body.inner, inner_flat), out = norm_bends(jet.outer, body.outer, outer_flat);
  const T inverse = T(1.0) / jet.h;
  const T tt = out.xx * inverse, tz = out.xy * inverse, slope = out.dx_over_x * inverse;
  const Vec<T>& a = jet.signed_axes;
  const T x = a.x * jet.inner.dx, y = a.y * jet.inner.dy;
  return {tt * x * x + slope * in.xx * (a.x * a.x),
          tt * y * y + slope * in.yy * (a.y * a.y),
          out.yy * inverse * (a.z * a.z),
          tt * x * y + slope * in.xy * (a.x * a.y),
          tz * x * a.z,
          tz * y * a.z};
}

}  // namespace
}  // namespace supernormal
