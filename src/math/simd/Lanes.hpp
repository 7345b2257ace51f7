// Vectors of real numbers, one number per SIMD lane.
//
// A file that includes this header may be compiled several times, for different instruction sets. Everything in it then lives in
// a namespace named after the set, so that the linker cannot take one version's inline function for another's. For the same
// reason nothing here calls the standard library's templates.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifndef HYBRIDGV_INSTRUCTION_SET
#define HYBRIDGV_INSTRUCTION_SET baseline
#endif

#define HYBRIDGV_INLINE __attribute__((always_inline)) inline

namespace hybridgv {
namespace HYBRIDGV_INSTRUCTION_SET {

// The widest vectors of the instruction set that this file is compiled for.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
constexpr int kVectorBytes = 64;
#elif defined(__AVX2__)
constexpr int kVectorBytes = 32;
#else
constexpr int kVectorBytes = 16;
#endif
using Floats = float __attribute__((vector_size(kVectorBytes)));
using Doubles = double __attribute__((vector_size(kVectorBytes)));
// What comparing two of them gives: all bits of a lane set where the comparison holds.
using FloatMask = int __attribute__((vector_size(kVectorBytes)));
using DoubleMask = long long __attribute__((vector_size(kVectorBytes)));

template <class V>
struct LaneTraits;
template <>
struct LaneTraits<Floats> {
  using Real = float;
  using Mask = FloatMask;
  static constexpr int kWidth = kVectorBytes / 4;
};
template <>
struct LaneTraits<Doubles> {
  using Real = double;
  using Mask = DoubleMask;
  static constexpr int kWidth = kVectorBytes / 8;
};
template <class V>
using Real = typename LaneTraits<V>::Real;
template <class V>
using Mask = typename LaneTraits<V>::Mask;

template <class V>
HYBRIDGV_INLINE V broadcast(Real<V> value) {
  return V{} + value;
}
template <class V>
HYBRIDGV_INLINE V select(Mask<V> mask, V yes, V no) {
  return mask ? yes : no;
}
// The arguments' order matters for NaN: smaller(NaN, b) = b, larger(NaN, b) = b.
template <class V>
HYBRIDGV_INLINE V smaller(V a, V b) {
  return a < b ? a : b;
}
template <class V>
HYBRIDGV_INLINE V larger(V a, V b) {
  return a > b ? a : b;
}

// Bit i is set if lane i is.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
HYBRIDGV_INLINE unsigned bits(FloatMask mask) { return _mm512_movepi32_mask((__m512i)mask); }
HYBRIDGV_INLINE unsigned bits(DoubleMask mask) { return _mm512_movepi64_mask((__m512i)mask); }
HYBRIDGV_INLINE Floats squareRoot(Floats x) { return _mm512_maskz_sqrt_ps(0xffff, x); }
HYBRIDGV_INLINE Doubles squareRoot(Doubles x) { return _mm512_maskz_sqrt_pd(0xff, x); }
#elif defined(__AVX2__)
HYBRIDGV_INLINE unsigned bits(FloatMask mask) { return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask)); }
HYBRIDGV_INLINE unsigned bits(DoubleMask mask) { return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask)); }
HYBRIDGV_INLINE Floats squareRoot(Floats x) { return _mm256_sqrt_ps(x); }
HYBRIDGV_INLINE Doubles squareRoot(Doubles x) { return _mm256_sqrt_pd(x); }
#elif defined(__x86_64__)
HYBRIDGV_INLINE unsigned bits(FloatMask mask) { return static_cast<unsigned>(_mm_movemask_ps((__m128)mask)); }
HYBRIDGV_INLINE unsigned bits(DoubleMask mask) { return static_cast<unsigned>(_mm_movemask_pd((__m128d)mask)); }
HYBRIDGV_INLINE Floats squareRoot(Floats x) { return _mm_sqrt_ps(x); }
HYBRIDGV_INLINE Doubles squareRoot(Doubles x) { return _mm_sqrt_pd(x); }
#else
template <class M>
HYBRIDGV_INLINE unsigned bits(M mask) {
  unsigned result = 0;
  for (unsigned i = 0; i < sizeof(mask) / sizeof(mask[0]); ++i) result |= mask[i] ? 1u << i : 0u;
  return result;
}
HYBRIDGV_INLINE Floats squareRoot(Floats x) {
  for (int i = 0; i < kVectorBytes / 4; ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
}
HYBRIDGV_INLINE Doubles squareRoot(Doubles x) {
  for (int i = 0; i < kVectorBytes / 8; ++i) x[i] = __builtin_sqrt(x[i]);
  return x;
}
#endif

// A complex number per lane, real and imaginary parts in separate vectors.
template <class V>
struct Complex {
  V re, im;
};

template <class V>
HYBRIDGV_INLINE Complex<V> operator+(const Complex<V>& a, const Complex<V>& b) {
  return {a.re + b.re, a.im + b.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator-(const Complex<V>& a, const Complex<V>& b) {
  return {a.re - b.re, a.im - b.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator-(const Complex<V>& a) {
  return {-a.re, -a.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator*(const Complex<V>& a, const Complex<V>& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> operator*(const V& a, const Complex<V>& b) {
  return {a * b.re, a * b.im};
}
// c + a b and c - a b, in two fused operations per part where the processor has them
template <class V>
HYBRIDGV_INLINE Complex<V> addProduct(const Complex<V>& c, const Complex<V>& a, const Complex<V>& b) {
  return {c.re + a.re * b.re - a.im * b.im, c.im + a.re * b.im + a.im * b.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> subtractProduct(const Complex<V>& c, const Complex<V>& a, const Complex<V>& b) {
  return {c.re - a.re * b.re + a.im * b.im, c.im - a.re * b.im - a.im * b.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> twice(const Complex<V>& a) {
  return {a.re + a.re, a.im + a.im};
}
template <class V>
HYBRIDGV_INLINE Complex<V> timesI(const Complex<V>& a) {
  return {-a.im, a.re};
}
template <class V>
HYBRIDGV_INLINE Complex<V> conjugate(const Complex<V>& a) {
  return {a.re, -a.im};
}
template <class V>
HYBRIDGV_INLINE V squaredNorm(const Complex<V>& a) {
  return a.re * a.re + a.im * a.im;
}
template <class V>
HYBRIDGV_INLINE Complex<V> reciprocal(const Complex<V>& a) {
  const V scale = 1 / squaredNorm(a);
  return {a.re * scale, -a.im * scale};
}
template <class V>
HYBRIDGV_INLINE Complex<V> select(Mask<V> mask, const Complex<V>& yes, const Complex<V>& no) {
  return {mask ? yes.re : no.re, mask ? yes.im : no.im};
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace hybridgv
