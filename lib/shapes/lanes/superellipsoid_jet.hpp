// Support function, boundary point and Hessian of superellipsoids in lanes (supernormal/shapes/superellipsoid.hpp).
#pragma once

#include "shapes/lanes/powers.hpp"
#include "shapes/lanes/vectors.hpp"

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): real.hpp

// The same limits as in power_norm.cpp. A ratio below kFlatRatio has a second derivative that stays constant. Below kLeastRatio the
// power is constant as well: the logarithm takes normal numbers.
constexpr double kLanesFlatRatio = 1e-60;
constexpr double kLanesLeastRatio = 1e-300;

/// A norm (x^p + y^p)^(1/p) of two numbers.
template <typename T>
struct NormExponents {
  T power_1;  ///< p - 1
  T inverse;  ///< 1/p
};

/// A norm and its first derivatives, with what the second derivatives need.
template <typename T>
struct NormJet {
  T value, dx, dy;
  T k, power_1, root, d_larger;  // k = smaller/larger; power_1 = k^(p-1)
  typename T::Mask x_is_larger;
};

template <typename T>
SUPERNORMAL_INLINE NormJet<T> norm_jet(T x, T y, const NormExponents<T>& p) {
  NormJet<T> out;
  out.x_is_larger = y < x;
  const T larger = max(x, y), smaller = min(x, y);
  // At the origin the direction is undefined. The values are then the values for x = y.
  const auto is_positive = T(0.0) < larger;
  out.k = select(is_positive, smaller, T(1.0)) / select(is_positive, larger, T(1.0));
  out.power_1 = select(T(0.0) < out.k, power(max(out.k, T(kLanesLeastRatio)), p.power_1), T(0.0));
  const T sum = out.power_1 * out.k + 1.0;
  out.root = root(sum, p.inverse);
  out.value = larger * out.root;
  out.d_larger = out.root / sum;
  const T d_smaller = out.d_larger * out.power_1;
  out.dx = select(out.x_is_larger, out.d_larger, d_smaller);
  out.dy = select(out.x_is_larger, d_smaller, out.d_larger);
  return out;
}

/// The value alone.
template <typename T>
SUPERNORMAL_INLINE T norm_value(T x, T y, const NormExponents<T>& p) {
  const T larger = max(x, y), smaller = min(x, y);
  const auto is_positive = T(0.0) < larger;
  const T k = select(is_positive, smaller, T(1.0)) / select(is_positive, larger, T(1.0));
  const T power_1 = select(T(0.0) < k, power(max(k, T(kLanesLeastRatio)), p.power_1), T(0.0));
  return larger * root(power_1 * k + 1.0, p.inverse);
}

/// Two numbers with the ratio of the norm's first derivatives; the larger is 1.
template <typename T>
SUPERNORMAL_INLINE void gradient_direction(T x, T y, T p_minus_1, T& dx, T& dy) {
  const auto x_is_larger = y < x;
  const T larger = max(x, y), smaller = min(x, y);
  const auto is_positive = T(0.0) < larger;
  const T k = select(is_positive, smaller, T(1.0)) / select(is_positive, larger, T(1.0));
  const T power_1 = select(T(0.0) < k, power(max(k, T(kLanesLeastRatio)), p_minus_1), T(0.0));
  dx = select(x_is_larger, T(1.0), power_1);
  dy = select(x_is_larger, power_1, T(1.0));
}

/// The second derivatives times the value, and value * dx / x.
template <typename T>
struct NormBends {
  T xx, xy, yy, dx_over_x;
};

/// `flat` is kFlatRatio^(p-2).
template <typename T>
SUPERNORMAL_INLINE NormBends<T> norm_bends(const NormJet<T>& norm, const NormExponents<T>& p, T flat) {
  const auto is_plain = T(kLanesFlatRatio) < norm.k;
  const T power_2 = select(is_plain, norm.power_1 / select(is_plain, norm.k, T(1.0)), flat);
  const T scale = p.power_1 * norm.d_larger * norm.d_larger;
  const T small = scale * norm.power_1 * norm.k, large = scale * power_2;
  return {select(norm.x_is_larger, small, large), -(scale * norm.power_1), select(norm.x_is_larger, large, small),
          norm.d_larger * norm.root * select(norm.x_is_larger, T(1.0), power_2)};
}

/// The numbers of a body that an evaluation needs.
template <typename T>
struct PowerBody {
  Vec<T> half;  ///< m
  NormExponents<T> inner, outer;
};

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
