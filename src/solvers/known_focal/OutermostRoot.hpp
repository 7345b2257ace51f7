// One real root of a cubic, in every lane.
#pragma once

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {
namespace HYBRIDGV_INSTRUCTION_SET {

using namespace math;

template <class V>
struct BitsOf {
  using Type = Mask<V>;
};
template <>
struct BitsOf<double> {
  using Type = long long;
};
template <class To, class From>
HYBRIDGV_INLINE To bitCast(From value) {
  static_assert(sizeof(To) == sizeof(From), "");
  To result;
  __builtin_memcpy(&result, &value, sizeof result);
  return result;
}

// Of normal positive numbers, to 1e-4: by the third part of the exponent, and a step of Halley's method.
template <class V>
HYBRIDGV_INLINE V cubeRootEstimate(V x) {
  using Bits = typename BitsOf<V>::Type;
  // The bits of 1.5 2^52 + n are those of 1.5 2^52, plus n.
  constexpr double kLarge = 6755399441055744, kExponentOfOne = 1072693248, kMiddle = 0.9667;
  constexpr long long kBitsOfLarge = 0x4338000000000000;
  const V exponent = bitCast<V>(Bits((bitCast<Bits>(x) >> 32) + kBitsOfLarge)) - kLarge;
  const V third = exponent / 3 + (kLarge + 2 * kExponentOfOne / 3 - (1 - kMiddle) * 1048576);
  const V y = bitCast<V>(Bits((bitCast<Bits>(third) - kBitsOfLarge) << 32)), yyy = y * y * y;
  return y * (yyy + 2 * x) / (2 * yyy + x);
}

// y as a zero of y^3 - 3 p y - F, improved by Newton's method or, with the second derivative, by Halley's.
template <class V>
HYBRIDGV_INLINE V newtonStep(V y, V p, V F) {
  return y - (y * (y * y - 3 * p) - F) / (3 * (y * y - p));
}
template <class V>
HYBRIDGV_INLINE V halleyStep(V y, V p, V F) {
  const V value = y * (y * y - 3 * p) - F, slope = 3 * (y * y - p);
  return y - value * slope / (slope * slope - 3 * y * value);
}

// The real root of y^3 - 3 p y + F that is farthest from zero; its sign is opposite to that of F. Both starts are so near that after
// both steps the root is exact to rounding.
template <class V>
HYBRIDGV_INLINE V outermostRoot(V p, V F) {
  constexpr double kLeast = 1e-290;
  const V absF = absolute(F), square = F * F - 4 * p * (p * p);
  const Mask<V> areThreeReal = square < 0;
  V y{};
  if (any(areThreeReal)) {
    // Of three real roots 2 sqrt(p) cos(arccos(t) / 3) is the largest: here to 8e-4.
    const V root = squareRoot(p), t = absF / (2 * p * root);
    y = root * (1.732787 + t * (0.319656 - t * 0.052919));
  }
  Mask<V> isZero = Mask<V>{};
  if (any(negated<Mask<V>>(areThreeReal))) {
    const V cube = (absF + squareRoot(square)) / 2, u = cubeRootEstimate(cube);
    isZero = negated<Mask<V>>(anyOf<Mask<V>>(areThreeReal, cube > kLeast));
    y = select<V>(areThreeReal, y, u + p / u);  // where p < 0 the two may cancel
  }
  y = newtonStep(halleyStep(y, p, absF), p, absF);
  y = select<V>(isZero, V{}, y);
  return select<V>(F > 0, -y, y);
}

// Where x^3 + b x^2 + c x + d is zero, as far from the inflection point as possible: that root is simple even where two solutions
// coincide.
template <class V>
HYBRIDGV_INLINE V cubicRoot(V b, V c, V d) {
  const V m = -b / 3, p = m * m - c / 3;
  return m + outermostRoot<V>(p, ((m + b) * m + c) * m + d);
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv
