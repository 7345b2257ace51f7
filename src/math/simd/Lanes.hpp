// Vectors of real numbers, one number per SIMD lane: the only vector types of the library, and what is done with them.
//
// +, -, *, / and comparisons work lane by lane, also with a number. The functions take a number as well, as a vector of one lane,
// so that a formula that is a template serves for both.
//
// A file that includes this header may be compiled several times, for different instruction sets. Everything in it then lives in
// an inline namespace named after the set, so that the linker cannot take one version's inline function for another's. For the
// same reason nothing here calls the standard library's templates. Files that are compiled only once need not name a set.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#ifndef HYBRIDGV_INSTRUCTION_SET
#define HYBRIDGV_INSTRUCTION_SET ordinary
#endif

#define HYBRIDGV_INLINE __attribute__((always_inline)) inline

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

// The widest vectors of the instruction set that this file is compiled for.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define HYBRIDGV_VECTOR_BYTES 64
#elif defined(__AVX2__)
#define HYBRIDGV_VECTOR_BYTES 32
#else
#define HYBRIDGV_VECTOR_BYTES 16
#endif
constexpr int kVectorBytes = HYBRIDGV_VECTOR_BYTES;
using Floats = float __attribute__((vector_size(HYBRIDGV_VECTOR_BYTES)));
using Doubles = double __attribute__((vector_size(HYBRIDGV_VECTOR_BYTES)));
// Two numbers: what fits the registers of every processor. The same type as Doubles where these are no wider.
using Pair = double __attribute__((vector_size(16)));

// What comparing two of them gives: all bits of a lane set where the comparison holds.
using FloatMask = decltype(Floats{} < Floats{});
using DoubleMask = decltype(Doubles{} < Doubles{});
using PairMask = decltype(Pair{} < Pair{});

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
#if HYBRIDGV_VECTOR_BYTES > 16
template <>
struct LaneTraits<Pair> {
  using Real = double;
  using Mask = PairMask;
  static constexpr int kWidth = 2;
};
#endif
template <>
struct LaneTraits<double> {
  using Real = double;
  using Mask = bool;
  static constexpr int kWidth = 1;
};
template <class V>
using Real = typename LaneTraits<V>::Real;
template <class V>
using Mask = typename LaneTraits<V>::Mask;

template <class V>
HYBRIDGV_INLINE V load(const Real<V>* from) {
  V result;
  __builtin_memcpy(&result, from, sizeof result);
  return result;
}
template <class V>
HYBRIDGV_INLINE void store(Real<V>* to, V value) {
  __builtin_memcpy(to, &value, sizeof value);
}
// Subtracting 0 changes no number, so that the compiler leaves it out; adding 0 would change -0.
template <class V>
HYBRIDGV_INLINE V broadcast(Real<V> value) {
  return value - V{};
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
template <class V>
HYBRIDGV_INLINE Mask<V> signBit() {
  return (Mask<V>)(-V{});
}
template <class V>
HYBRIDGV_INLINE V absolute(V a) {
  return (V)((Mask<V>)a & ~signBit<V>());
}
HYBRIDGV_INLINE double absolute(double a) { return __builtin_fabs(a); }

// bits(mask): bit i is set if lane i is.
#if defined(__x86_64__)
HYBRIDGV_INLINE unsigned bits(PairMask mask) { return static_cast<unsigned>(_mm_movemask_pd((__m128d)mask)); }
HYBRIDGV_INLINE Pair squareRoot(Pair x) { return _mm_sqrt_pd(x); }
#if HYBRIDGV_VECTOR_BYTES == 64
HYBRIDGV_INLINE unsigned bits(FloatMask mask) { return _mm512_movepi32_mask((__m512i)mask); }
HYBRIDGV_INLINE unsigned bits(DoubleMask mask) { return _mm512_movepi64_mask((__m512i)mask); }
HYBRIDGV_INLINE Floats squareRoot(Floats x) { return _mm512_maskz_sqrt_ps(0xffff, x); }
HYBRIDGV_INLINE Doubles squareRoot(Doubles x) { return _mm512_maskz_sqrt_pd(0xff, x); }
#elif HYBRIDGV_VECTOR_BYTES == 32
HYBRIDGV_INLINE unsigned bits(FloatMask mask) { return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask)); }
HYBRIDGV_INLINE unsigned bits(DoubleMask mask) { return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask)); }
HYBRIDGV_INLINE Floats squareRoot(Floats x) { return _mm256_sqrt_ps(x); }
HYBRIDGV_INLINE Doubles squareRoot(Doubles x) { return _mm256_sqrt_pd(x); }
#else
HYBRIDGV_INLINE unsigned bits(FloatMask mask) { return static_cast<unsigned>(_mm_movemask_ps((__m128)mask)); }
HYBRIDGV_INLINE Floats squareRoot(Floats x) { return _mm_sqrt_ps(x); }
#endif
#elif defined(__aarch64__)
HYBRIDGV_INLINE unsigned bits(FloatMask mask) {
  constexpr FloatMask kBitOfLane = {1, 2, 4, 8};
  return vaddvq_u32((uint32x4_t)(mask & kBitOfLane));
}
HYBRIDGV_INLINE unsigned bits(DoubleMask mask) {
  constexpr DoubleMask kBitOfLane = {1, 2};
  return static_cast<unsigned>(vaddvq_u64((uint64x2_t)(mask & kBitOfLane)));
}
HYBRIDGV_INLINE Floats squareRoot(Floats x) { return (Floats)vsqrtq_f32((float32x4_t)x); }
HYBRIDGV_INLINE Doubles squareRoot(Doubles x) { return (Doubles)vsqrtq_f64((float64x2_t)x); }
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
HYBRIDGV_INLINE double squareRoot(double x) { return __builtin_sqrt(x); }
HYBRIDGV_INLINE unsigned bits(bool mask) { return mask ? 1 : 0; }

template <class M>
HYBRIDGV_INLINE bool any(M mask) {
  return bits(mask) != 0;
}
// Of masks, the same for those of one lane, for which & and | are meant for numbers.
template <class M>
HYBRIDGV_INLINE M allOf(M a, M b) {
  return a & b;
}
template <class M>
HYBRIDGV_INLINE M anyOf(M a, M b) {
  return a | b;
}
HYBRIDGV_INLINE bool allOf(bool a, bool b) { return a && b; }
HYBRIDGV_INLINE bool anyOf(bool a, bool b) { return a || b; }
template <class M>
HYBRIDGV_INLINE M allOf(M a, M b, M c) {
  return allOf(allOf(a, b), c);
}
template <class M>
HYBRIDGV_INLINE M negated(M mask) {
  return mask == M{};
}
// From the first lane to the last.
template <class V>
HYBRIDGV_INLINE Real<V> sum(V value) {
  Real<V> result = 0;
  for (int i = 0; i < LaneTraits<V>::kWidth; ++i) result += value[i];
  return result;
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv
