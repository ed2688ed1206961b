// Doubles in lanes: W numbers on which one operation acts at once.
//
// The same source is compiled once for each instruction set, and the digits must not depend on the width, so every operation here
// is one correctly rounded operation per lane. Nothing is fused (-ffp-contract=off), and nothing comes from libm, whose pow, log
// and exp depend on the processor.
//
// The files that include this header for wide registers include no Eigen and no inline function of the standard library. A linker
// keeps one copy of an inline function, and a copy with AVX instructions would then run on every machine. The names here are in an
// unnamed namespace for the same reason.
#pragma once

#if defined(__AVX2__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

#define SUPERNORMAL_INLINE inline __attribute__((always_inline))

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): see above

/// The binary representations of W numbers: sign, 11 bits of the exponent, 52 of the mantissa.
template <int W>
struct Bits;

/// For each lane, whether something holds: 0 or -1.
template <int W>
struct Mask;

/// W numbers.
template <int W>
struct Real;

// One specialization a width, because a vector type of GCC and clang may not depend on a parameter of a template.
#define SUPERNORMAL_WIDTH(W)                                              \
  template <>                                                             \
  struct Bits<W> {                                                        \
    using Raw = unsigned long long __attribute__((vector_size(8 * (W)))); \
    Raw v;                                                                \
  };                                                                      \
  template <>                                                             \
  struct Mask<W> {                                                        \
    using Raw = long long __attribute__((vector_size(8 * (W))));          \
    Raw v;                                                                \
  };                                                                      \
  template <>                                                             \
  struct Real<W> {                                                        \
    using Raw = double __attribute__((vector_size(8 * (W))));             \
    using Mask = supernormal::Mask<W>;                                    \
    Raw v;                                                                \
    Real() = default;                                                     \
    SUPERNORMAL_INLINE Real(Raw raw) : v(raw) {}                          \
    SUPERNORMAL_INLINE Real(double x) : v(Raw{} + x) {}                   \
  };
SUPERNORMAL_WIDTH(2)
SUPERNORMAL_WIDTH(4)
SUPERNORMAL_WIDTH(8)
#undef SUPERNORMAL_WIDTH

template <>
struct Bits<1> {
  using Raw = unsigned long long;
  Raw v;
};

template <>
struct Mask<1> {
  bool v;
};

template <>
struct Real<1> {
  using Raw = double;
  using Mask = supernormal::Mask<1>;
  double v;
  Real() = default;
  SUPERNORMAL_INLINE Real(double x) : v(x) {}
};

#define SUPERNORMAL_LANES \
  template <int W>        \
  SUPERNORMAL_INLINE

SUPERNORMAL_LANES Real<W> operator+(Real<W> a, Real<W> b) { return {a.v + b.v}; }
SUPERNORMAL_LANES Real<W> operator-(Real<W> a, Real<W> b) { return {a.v - b.v}; }
SUPERNORMAL_LANES Real<W> operator*(Real<W> a, Real<W> b) { return {a.v * b.v}; }
SUPERNORMAL_LANES Real<W> operator/(Real<W> a, Real<W> b) { return {a.v / b.v}; }
SUPERNORMAL_LANES Real<W> operator-(Real<W> a) { return {-a.v}; }
SUPERNORMAL_LANES Real<W> operator+(Real<W> a, double b) { return a + Real<W>(b); }
SUPERNORMAL_LANES Real<W> operator-(Real<W> a, double b) { return a - Real<W>(b); }
SUPERNORMAL_LANES Real<W> operator*(Real<W> a, double b) { return a * Real<W>(b); }
SUPERNORMAL_LANES Mask<W> operator<(Real<W> a, Real<W> b) { return {a.v < b.v}; }
SUPERNORMAL_LANES Mask<W> operator<=(Real<W> a, Real<W> b) { return {a.v <= b.v}; }

SUPERNORMAL_LANES Mask<W> operator&(Mask<W> a, Mask<W> b) { return {a.v & b.v}; }
SUPERNORMAL_LANES Mask<W> operator|(Mask<W> a, Mask<W> b) { return {a.v | b.v}; }
SUPERNORMAL_LANES Mask<W> operator~(Mask<W> a) { return {~a.v}; }
template <>
SUPERNORMAL_INLINE Mask<1> operator&(Mask<1> a, Mask<1> b) {
  return {a.v && b.v};
}
template <>
SUPERNORMAL_INLINE Mask<1> operator|(Mask<1> a, Mask<1> b) {
  return {a.v || b.v};
}
template <>
SUPERNORMAL_INLINE Mask<1> operator~(Mask<1> a) {
  return {!a.v};
}

/// a where the mask holds, b elsewhere.
SUPERNORMAL_LANES Real<W> select(Mask<W> mask, Real<W> a, Real<W> b) { return {mask.v ? a.v : b.v}; }

/// The smaller and the larger number; b where they are equal.
SUPERNORMAL_LANES Real<W> min(Real<W> a, Real<W> b) { return {a.v < b.v ? a.v : b.v}; }
SUPERNORMAL_LANES Real<W> max(Real<W> a, Real<W> b) { return {a.v > b.v ? a.v : b.v}; }

/// Bit k says whether the mask holds in lane k.
SUPERNORMAL_LANES unsigned lanes_of(Mask<W> mask) {
#if defined(__AVX2__)
  if constexpr (W == 4) return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask.v)));
#endif
#if defined(__AVX512F__)
  if constexpr (W == 8) return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(mask.v), reinterpret_cast<__m512i>(mask.v));
#endif
  unsigned result = 0;
  for (int k = 0; k < W; ++k) result |= static_cast<unsigned>(mask.v[k] & 1) << k;
  return result;
}
template <>
SUPERNORMAL_INLINE unsigned lanes_of(Mask<1> mask) {
  return mask.v ? 1 : 0;
}
SUPERNORMAL_LANES bool any(Mask<W> mask) { return lanes_of(mask) != 0; }

SUPERNORMAL_LANES Real<W> sqrt(Real<W> a) {
#if defined(__AVX2__)
  if constexpr (W == 4) return {_mm256_sqrt_pd(a.v)};
#endif
#if defined(__AVX512F__)
  if constexpr (W == 8) return {_mm512_maskz_sqrt_pd(0xff, a.v)};  // every lane; without the mask GCC 12 warns
#endif
  Real<W> result;
  for (int k = 0; k < W; ++k) result.v[k] = __builtin_sqrt(a.v[k]);
  return result;
}
template <>
SUPERNORMAL_INLINE Real<1> sqrt(Real<1> a) {
  return {__builtin_sqrt(a.v)};
}

SUPERNORMAL_LANES Bits<W> bits_of(Real<W> a) { return {reinterpret_cast<typename Bits<W>::Raw>(a.v)}; }
SUPERNORMAL_LANES Real<W> from_bits(Bits<W> a) { return {reinterpret_cast<typename Real<W>::Raw>(a.v)}; }
template <>
SUPERNORMAL_INLINE Bits<1> bits_of(Real<1> a) {
  return {__builtin_bit_cast(unsigned long long, a.v)};
}
template <>
SUPERNORMAL_INLINE Real<1> from_bits(Bits<1> a) {
  return {__builtin_bit_cast(double, a.v)};
}
SUPERNORMAL_LANES Bits<W> operator+(Bits<W> a, Bits<W> b) { return {a.v + b.v}; }
SUPERNORMAL_LANES Bits<W> operator-(Bits<W> a, Bits<W> b) { return {a.v - b.v}; }
SUPERNORMAL_LANES Bits<W> operator+(Bits<W> a, unsigned long long b) { return {a.v + b}; }
SUPERNORMAL_LANES Bits<W> operator-(Bits<W> a, unsigned long long b) { return {a.v - b}; }
SUPERNORMAL_LANES Bits<W> operator&(Bits<W> a, unsigned long long b) { return {a.v & b}; }
SUPERNORMAL_LANES Bits<W> operator|(Bits<W> a, unsigned long long b) { return {a.v | b}; }
SUPERNORMAL_LANES Bits<W> operator|(Bits<W> a, Bits<W> b) { return {a.v | b.v}; }
SUPERNORMAL_LANES Bits<W> operator<<(Bits<W> a, int count) { return {a.v << count}; }
SUPERNORMAL_LANES Bits<W> operator>>(Bits<W> a, int count) { return {a.v >> count}; }

constexpr unsigned long long kSignBit = 0x8000000000000000ULL;

SUPERNORMAL_LANES Real<W> abs(Real<W> a) { return from_bits(bits_of(a) & ~kSignBit); }
/// `magnitude`, which is not negative, with the sign of `sign`.
SUPERNORMAL_LANES Real<W> with_sign(Real<W> magnitude, Real<W> sign) {
  return from_bits(bits_of(magnitude) | (bits_of(sign) & kSignBit));
}

/// The number as a double holds it. x87 computes with more digits.
SUPERNORMAL_LANES Real<W> stored(Real<W> a) {
#if __FLT_EVAL_METHOD__ == 2
  const volatile Real<W> in_memory = a;
  __builtin_memcpy(&a.v, const_cast<const typename Real<W>::Raw*>(&in_memory.v), sizeof a.v);
#endif
  return a;
}

/// The numbers of all lanes, from a function of the lane. The registers are filled without a way through memory.
template <int W, typename Number>
SUPERNORMAL_INLINE Real<W> lanes_from(const Number& number) {
  if constexpr (W == 1) {
    return Real<1>(number(0));
  } else if constexpr (W == 2) {
    return Real<2>(typename Real<2>::Raw{number(0), number(1)});
  } else if constexpr (W == 4) {
    return Real<4>(typename Real<4>::Raw{number(0), number(1), number(2), number(3)});
  } else {
    return Real<8>(typename Real<8>::Raw{number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7)});
  }
}

SUPERNORMAL_LANES Real<W> load(const double* from) {
  Real<W> result;
  __builtin_memcpy(&result.v, from, sizeof result.v);
  return result;
}
SUPERNORMAL_LANES void store(double* to, Real<W> a) { __builtin_memcpy(to, &a.v, sizeof a.v); }

template <typename M>
struct TwoMasks {
  M a, b;
};
/// Two numbers side by side, for the two bodies of a pair. Their operations alternate, so that one body's do not wait for each
/// other.
template <typename Real>
struct Two {
  using Mask = TwoMasks<typename Real::Mask>;
  Real a, b;
  Two() = default;
  SUPERNORMAL_INLINE Two(Real x, Real y) : a(x), b(y) {}
  SUPERNORMAL_INLINE Two(double x) : a(x), b(x) {}
};

#define SUPERNORMAL_TWO \
  template <typename R> \
  SUPERNORMAL_INLINE
SUPERNORMAL_TWO Two<R> operator+(Two<R> x, Two<R> y) { return {x.a + y.a, x.b + y.b}; }
SUPERNORMAL_TWO Two<R> operator-(Two<R> x, Two<R> y) { return {x.a - y.a, x.b - y.b}; }
SUPERNORMAL_TWO Two<R> operator*(Two<R> x, Two<R> y) { return {x.a * y.a, x.b * y.b}; }
SUPERNORMAL_TWO Two<R> operator/(Two<R> x, Two<R> y) { return {x.a / y.a, x.b / y.b}; }
SUPERNORMAL_TWO Two<R> operator-(Two<R> x) { return {-x.a, -x.b}; }
SUPERNORMAL_TWO Two<R> operator+(Two<R> x, double y) { return {x.a + y, x.b + y}; }
SUPERNORMAL_TWO Two<R> operator*(Two<R> x, double y) { return {x.a * y, x.b * y}; }
SUPERNORMAL_TWO typename Two<R>::Mask operator<(Two<R> x, Two<R> y) { return {x.a < y.a, x.b < y.b}; }
SUPERNORMAL_TWO Two<R> select(typename Two<R>::Mask mask, Two<R> x, Two<R> y) {
  return {select(mask.a, x.a, y.a), select(mask.b, x.b, y.b)};
}
SUPERNORMAL_TWO Two<R> min(Two<R> x, Two<R> y) { return {min(x.a, y.a), min(x.b, y.b)}; }
SUPERNORMAL_TWO Two<R> max(Two<R> x, Two<R> y) { return {max(x.a, y.a), max(x.b, y.b)}; }
SUPERNORMAL_TWO Two<R> sqrt(Two<R> x) { return {sqrt(x.a), sqrt(x.b)}; }
SUPERNORMAL_TWO Two<R> abs(Two<R> x) { return {abs(x.a), abs(x.b)}; }
SUPERNORMAL_TWO Two<R> with_sign(Two<R> x, Two<R> y) { return {with_sign(x.a, y.a), with_sign(x.b, y.b)}; }

/// The two of W lanes. In one lane they fill one register.
template <int W>
struct SideBySide {
  using Type = Two<Real<W>>;
  SUPERNORMAL_INLINE static Type of(Real<W> x, Real<W> y) { return {x, y}; }
};
template <>
struct SideBySide<1> {
  using Type = Real<2>;
  SUPERNORMAL_INLINE static Type of(Real<1> x, Real<1> y) { return Type::Raw{x.v, y.v}; }
};

SUPERNORMAL_TWO R first(Two<R> x) { return x.a; }
SUPERNORMAL_TWO R second(Two<R> x) { return x.b; }
SUPERNORMAL_TWO R first(TwoMasks<R> x) { return x.a; }
SUPERNORMAL_TWO R second(TwoMasks<R> x) { return x.b; }
SUPERNORMAL_INLINE Real<1> first(Real<2> x) { return x.v[0]; }
SUPERNORMAL_INLINE Real<1> second(Real<2> x) { return x.v[1]; }
SUPERNORMAL_INLINE Mask<1> first(Mask<2> x) { return {x.v[0] != 0}; }
SUPERNORMAL_INLINE Mask<1> second(Mask<2> x) { return {x.v[1] != 0}; }

}  // namespace
}  // namespace supernormal
