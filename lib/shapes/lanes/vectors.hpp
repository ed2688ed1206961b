// Vectors and symmetric matrices of lanes.
#pragma once

#include "shapes/lanes/real.hpp"

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): real.hpp

template <typename T>
struct Vec {
  T x, y, z;
};

/// A symmetric matrix.
template <typename T>
struct Sym {
  T xx, yy, zz, xy, xz, yz;
};

/// A matrix by its columns.
template <typename T>
struct Mat {
  Vec<T> x, y, z;
};

#define SUPERNORMAL_VEC \
  template <typename T> \
  SUPERNORMAL_INLINE
SUPERNORMAL_VEC Vec<T> operator+(Vec<T> a, Vec<T> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
SUPERNORMAL_VEC Vec<T> operator-(Vec<T> a, Vec<T> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
SUPERNORMAL_VEC Vec<T> operator-(Vec<T> a) { return {-a.x, -a.y, -a.z}; }
SUPERNORMAL_VEC Vec<T> operator*(Vec<T> a, T b) { return {a.x * b, a.y * b, a.z * b}; }
SUPERNORMAL_VEC T dot(Vec<T> a, Vec<T> b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
SUPERNORMAL_VEC Vec<T> cross(Vec<T> a, Vec<T> b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
SUPERNORMAL_VEC T length(Vec<T> a) { return sqrt(dot(a, a)); }
/// The part of v across the unit vector n.
SUPERNORMAL_VEC Vec<T> part_across(Vec<T> v, Vec<T> n) { return v - n * dot(v, n); }
SUPERNORMAL_VEC Vec<T> unit(Vec<T> a) { return a * (T(1.0) / length(a)); }
SUPERNORMAL_VEC Vec<T> times(Vec<T> a, Vec<T> b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
// Of two side by side (SideBySide).
SUPERNORMAL_VEC auto first(const Vec<T>& a) -> Vec<decltype(first(a.x))> { return {first(a.x), first(a.y), first(a.z)}; }
SUPERNORMAL_VEC auto second(const Vec<T>& a) -> Vec<decltype(second(a.x))> { return {second(a.x), second(a.y), second(a.z)}; }
SUPERNORMAL_VEC T smallest(Vec<T> a) { return min(min(a.x, a.y), a.z); }
template <typename T, typename M>
SUPERNORMAL_INLINE Vec<T> select(M mask, Vec<T> a, Vec<T> b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

SUPERNORMAL_VEC Sym<T> operator+(Sym<T> a, Sym<T> b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
SUPERNORMAL_VEC Sym<T> operator*(Sym<T> a, T b) { return {a.xx * b, a.yy * b, a.zz * b, a.xy * b, a.xz * b, a.yz * b}; }
SUPERNORMAL_VEC T trace(const Sym<T>& a) { return a.xx + a.yy + a.zz; }
SUPERNORMAL_VEC Vec<T> operator*(const Sym<T>& a, Vec<T> v) {
  return {a.xx * v.x + (a.xy * v.y + a.xz * v.z), a.xy * v.x + (a.yy * v.y + a.yz * v.z), a.xz * v.x + (a.yz * v.y + a.zz * v.z)};
}
template <typename T, typename M>
SUPERNORMAL_INLINE Sym<T> select(M mask, const Sym<T>& a, const Sym<T>& b) {
  return {select(mask, a.xx, b.xx), select(mask, a.yy, b.yy), select(mask, a.zz, b.zz),
          select(mask, a.xy, b.xy), select(mask, a.xz, b.xz), select(mask, a.yz, b.yz)};
}
SUPERNORMAL_VEC auto first(const Sym<T>& a) -> Sym<decltype(first(a.xx))> {
  return {first(a.xx), first(a.yy), first(a.zz), first(a.xy), first(a.xz), first(a.yz)};
}
SUPERNORMAL_VEC auto second(const Sym<T>& a) -> Sym<decltype(second(a.xx))> {
  return {second(a.xx), second(a.yy), second(a.zz), second(a.xy), second(a.xz), second(a.yz)};
}
/// The matrix of the cofactors: the inverse times the determinant.
SUPERNORMAL_VEC Sym<T> cofactors(const Sym<T>& a) {
  return {a.yy * a.zz - a.yz * a.yz, a.xx * a.zz - a.xz * a.xz, a.xx * a.yy - a.xy * a.xy,
          a.xz * a.yz - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy, a.xy * a.xz - a.xx * a.yz};
}

SUPERNORMAL_VEC Vec<T> operator*(const Mat<T>& R, Vec<T> v) { return R.x * v.x + (R.y * v.y + R.z * v.z); }
/// R^T v
SUPERNORMAL_VEC Vec<T> transposed_times(const Mat<T>& R, Vec<T> v) { return {dot(R.x, v), dot(R.y, v), dot(R.z, v)}; }
/// R diag(d) R^T
SUPERNORMAL_VEC Sym<T> rotated_diagonal(const Mat<T>& R, Vec<T> d) {
  const Vec<T> x = R.x * d.x, y = R.y * d.y, z = R.z * d.z;
  return {x.x * R.x.x + (y.x * R.y.x + z.x * R.z.x), x.y * R.x.y + (y.y * R.y.y + z.y * R.z.y),
          x.z * R.x.z + (y.z * R.y.z + z.z * R.z.z), x.x * R.x.y + (y.x * R.y.y + z.x * R.z.y),
          x.x * R.x.z + (y.x * R.y.z + z.x * R.z.z), x.y * R.x.z + (y.y * R.y.z + z.y * R.z.z)};
}
/// R A R^T
SUPERNORMAL_VEC Sym<T> rotated(const Mat<T>& R, const Sym<T>& A) {
  const Vec<T> x = R * Vec<T>{A.xx, A.xy, A.xz}, y = R * Vec<T>{A.xy, A.yy, A.yz}, z = R * Vec<T>{A.xz, A.yz, A.zz};
  return {x.x * R.x.x + (y.x * R.y.x + z.x * R.z.x), x.y * R.x.y + (y.y * R.y.y + z.y * R.z.y),
          x.z * R.x.z + (y.z * R.y.z + z.z * R.z.z), x.x * R.x.y + (y.x * R.y.y + z.x * R.z.y),
          x.x * R.x.z + (y.x * R.y.z + z.x * R.z.z), x.y * R.x.z + (y.y * R.y.z + z.y * R.z.z)};
}

}  // namespace
}  // namespace supernormal
