// Powers of the library: x^p = 2^(p log2(x)), with a logarithm and a power of two of our own.
//
// The operations are the same in every width, so that the digits are. Compared with glibc's pow, which rounds almost correctly, an
// error of a few units of the last place remains (lib/shapes/README.md, "Powers").
#pragma once

#include "shapes/lanes/real.hpp"

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): real.hpp

// The polynomials are from coefficients.py.
constexpr double kExp2[] = {0x1.0000000000000p+0,  0x1.62e42fefa39efp-1,  0x1.ebfbdff82c5aep-3,  0x1.c6b08d704a0c6p-5,
                            0x1.3b2ab6fb9f1a5p-7,  0x1.5d87fe78a3f9cp-10, 0x1.430913112c61bp-13, 0x1.ffcbfc6da6ed1p-17,
                            0x1.62bfc2c86d700p-20, 0x1.b524ebd13a55fp-24, 0x1.e6228acd1c73ap-28, 0x1.e9ec1fcb69ac7p-32};
constexpr double kLog2Slope = 0x1.71547652b82fep+1, kLog2SlopeRest = 0x1.777d0ffda0d24p-55;
constexpr double kLog2[] = {0x1.ec709dc3a0401p-1, 0x1.2776c50ef68fbp-1, 0x1.a61762b532f39p-2, 0x1.484b091bb27d1p-2,
                            0x1.0c9e9175ed092p-2, 0x1.c4ff418a3f744p-3, 0x1.afdd06fa09a66p-3};

/// x = 2^e m with m in [sqrt(1/2), sqrt(2)), for a positive normal number: e, and the logarithm of m to base two.
template <int W>
SUPERNORMAL_INLINE void log2_parts(Real<W> x, Real<W>& e, Real<W>& of_m) {
  // The quotient x / sqrt(1/2) has the exponent e, so e + 1024 are the upper bits of the difference of the representations. These
  // bits behind those of 2^52 are the number 2^52 + e + 1024, without a conversion.
  constexpr unsigned long long kRootHalf = 0x3fe6a09e667f3bcdULL, kOffset = 0x4000000000000000ULL;
  constexpr unsigned long long kExponent = 0xfff0000000000000ULL, kTwo52 = 0x4330000000000000ULL;
  const Bits<W> above = bits_of(x) - kRootHalf;
  e = from_bits(((above + kOffset) >> 52) | kTwo52) - Real<W>(0x1p52 + 1024);
  const Real<W> m = from_bits(bits_of(x) - (above & kExponent));
  const Real<W> f = (m - 1.0) / (m + 1.0);
  const Real<W> z = f * f, z2 = z * z;
  const Real<W> low = Real<W>(kLog2[1]) * z + kLog2[0], middle = Real<W>(kLog2[3]) * z + kLog2[2];
  const Real<W> high = Real<W>(kLog2[6]) * z2 + (Real<W>(kLog2[5]) * z + kLog2[4]);
  const Real<W> q = (high * z2 + middle) * z2 + low;
  of_m = f * kLog2Slope + f * (z * q + kLog2SlopeRest);
}

// Adding 1.5 * 2^52 rounds to an integer, which then stands in the lowest bits.
constexpr double kToInteger = 0x1.8p52;

/// The integer nearest to a number within 2^51.
template <int W>
SUPERNORMAL_INLINE Real<W> nearest_integer(Real<W> a) {
  return stored(a + kToInteger) - kToInteger;
}

// 2^n is limited to this n, and 0 below the negative n. With lengths in [1e-30, 1e30] m, products with the other numbers remain
// normal.
constexpr double kMostExponent = 900;

/// 2^(n + r) for an integer n and |r| <= 1/2; 0 where n < -900, and n is limited to 900.
template <int W>
SUPERNORMAL_INLINE Real<W> exp2_parts(Real<W> n, Real<W> r) {
  const Mask<W> is_zero = n < Real<W>(-kMostExponent);
  n = min(max(n, Real<W>(-kMostExponent)), Real<W>(kMostExponent));
  const Real<W> r2 = r * r, r4 = r2 * r2;
  const auto pair = [&r](int k) { return Real<W>(kExp2[k + 1]) * r + kExp2[k]; };
  const Real<W> high = pair(10) * r2 + pair(8), middle = pair(6) * r2 + pair(4);
  const Real<W> low = pair(2) * r2 + Real<W>(kExp2[1]) * r;
  const Real<W> polynomial = ((high * r4 + middle) * r4 + low) + kExp2[0];  // 1 comes last, so that it rounds but once
  return select(is_zero, Real<W>(0.0), from_bits(bits_of(polynomial) + (bits_of(n + kToInteger) << 52)));
}

/// x^p for a positive normal number x and |p| <= 1000; 0 below 2^-900, and limited to 2^900. The relative error is a few units of
/// rounding, and |p| more for the rounding of log2(m).
template <int W>
SUPERNORMAL_INLINE Real<W> power(Real<W> x, Real<W> p) {
  Real<W> e, of_m;
  log2_parts(x, e, of_m);
  // The upper 41 bits of p times e, which has 11, are exact. So no digits are lost where p e is large.
  const Real<W> upper = from_bits(bits_of(p) & 0xfffffffffffff000ULL);
  const Real<W> product = upper * e;
  const Real<W> n1 = nearest_integer(product);
  const Real<W> rest = (product - n1) + ((p - upper) * e + p * of_m);
  const Real<W> n2 = nearest_integer(rest);
  return exp2_parts(n1 + n2, rest - n2);
}

/// sum^p for a number in [1, 4) and p in (0, 1].
template <int W>
SUPERNORMAL_INLINE Real<W> root(Real<W> sum, Real<W> p) {
  Real<W> e, of_m;
  log2_parts(sum, e, of_m);
  const Real<W> exponent = p * (e + of_m);
  const Real<W> n = nearest_integer(exponent);
  return exp2_parts(n, exponent - n);
}

template <typename R>
SUPERNORMAL_INLINE Two<R> power(Two<R> x, Two<R> p) {
  return {power(x.a, p.a), power(x.b, p.b)};
}
template <typename R>
SUPERNORMAL_INLINE Two<R> root(Two<R> x, Two<R> p) {
  return {root(x.a, p.a), root(x.b, p.b)};
}

}  // namespace
}  // namespace supernormal
