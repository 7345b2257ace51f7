// The natural logarithm of every lane.
#pragma once

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

// Of normal positive numbers, to 2 units in the last place. x = 2^k m with m in [sqrt(1/2), sqrt(2)), and
// log m = 2 artanh(s) = 2 s (1 + s^2 / 3 + s^4 / 5 + ..), s = (m - 1) / (m + 1), |s| < 0.172.
HYBRIDGV_INLINE Doubles logarithm(Doubles x) {
  constexpr long long kOne = 0x3ff0000000000000, kRootOfHalf = 0x3fe6a09e667f3bcd;  // bits of these numbers
  constexpr int kMantissaBits = 52;
  const DoubleMask bits = (DoubleMask)x;
  const DoubleMask biased = (bits + (kOne - kRootOfHalf)) >> kMantissaBits;  // k + 1023
  const Doubles m = (Doubles)(bits - ((biased - 1023) << kMantissaBits));
  // The bits of 1.5 2^52 + n are those of 1.5 2^52, plus n.
  constexpr double kLarge = 6755399441055744;
  const Doubles k = (Doubles)((DoubleMask)broadcast<Doubles>(kLarge) + biased) - (kLarge + 1023);
  const Doubles s = (m - 1.0) / (m + 1.0), z = s * s;
  Doubles series = broadcast<Doubles>(1.0 / 21);
  for (int odd = 19; odd >= 3; odd -= 2) series = series * z + 1.0 / odd;
  constexpr double kLogTwoHigh = 0x1.62e42fefa38p-1, kLogTwoLow = 0x1.ef35793c7673p-45;  // k kLogTwoHigh is exact
  return k * kLogTwoHigh + (2.0 * s + (2.0 * s * z * series + k * kLogTwoLow));
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv
