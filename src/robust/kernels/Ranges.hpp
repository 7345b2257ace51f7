// Loops over a range of correspondences, kWidth at a time.
#pragma once

#include <cstddef>

#include "robust/kernels/PoseLanes.hpp"

namespace hybridgv {
namespace robust {
namespace HYBRIDGV_INSTRUCTION_SET {

HYBRIDGV_INLINE DoubleMask allLanes() { return DoubleMask{} == DoubleMask{}; }
HYBRIDGV_INLINE DoubleMask lanesBelow(std::size_t count) {
  DoubleMask mask{};
  for (int lane = 0; lane < kWidth; ++lane) mask[lane] = static_cast<std::size_t>(lane) < count ? -1 : 0;
  return mask;
}

// Calls body(i, mask) for i = begin, begin + kWidth, .. below end; the mask tells which lanes are below it. The compiler
// makes two copies of the body, the first of which needs no mask.
template <class Body>
HYBRIDGV_INLINE void forRange(std::size_t begin, std::size_t end, Body body) {
  std::size_t i = begin;
  for (; i + kWidth <= end; i += kWidth) body(i, allLanes());
  if (i < end) body(i, lanesBelow(end - i));
}

// The same for a body so long that it is not made part of the loop if there are two copies.
template <class Body>
HYBRIDGV_INLINE void forRangeOfLongBody(std::size_t begin, std::size_t end, Body body) {
  for (std::size_t i = begin; i < end; i += kWidth) body(i, i + kWidth <= end ? allLanes() : lanesBelow(end - i));
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace robust
}  // namespace hybridgv
