// The instruction sets that the processor has.
#pragma once

#include <vector>

#include "math/simd/SimdLevel.hpp"

namespace hybridgv {
namespace test {

inline std::vector<math::SimdLevel> supportedLevels() {
  std::vector<math::SimdLevel> levels;
  for (const math::SimdLevel level : {math::SimdLevel::Baseline, math::SimdLevel::Avx2, math::SimdLevel::Avx512})
    if (level <= math::supportedSimdLevel()) levels.push_back(level);
  return levels;
}

}  // namespace test
}  // namespace hybridgv
