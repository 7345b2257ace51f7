#include "robust/Levels.hpp"

#include <cmath>

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace robust {

// Without branches: which errors are below which threshold cannot be foreseen.
LevelCounts countLevels(const double* squaredErrors, std::size_t size, double squaredThreshold) {
  using math::Pair;
  Pair thresholds[kLevels];
  for (Pair& threshold : thresholds) {
    threshold = Pair{squaredThreshold, squaredThreshold};
    squaredThreshold /= 4;
  }
  math::PairMask below[kLevels] = {};  // a lane counts down
  std::size_t i = 0;
  for (; i + 1 < size; i += 2) {
    const Pair errors = math::load<Pair>(squaredErrors + i);
    for (int level = 0; level < kLevels; ++level) below[level] += errors < thresholds[level];
  }
  LevelCounts counts;
  for (int level = 0; level < kLevels; ++level) {
    const bool isLast = i < size && squaredErrors[i] < thresholds[level][0];
    counts[static_cast<std::size_t>(level)] = static_cast<int>(-below[level][0] - below[level][1]) + (isLast ? 1 : 0);
  }
  return counts;
}

double thresholdAt(double threshold, int level) { return std::ldexp(threshold, -level); }

int clearestLevel(const LevelCounts& counts, std::size_t all, const LevelShares& chance, int fitted) {
  int clearest = 0;
  double largest = 0;
  for (int level = 0; level < kLevels; ++level) {
    const double expected = static_cast<double>(all) * chance[static_cast<std::size_t>(level)];
    const double excess = counts[static_cast<std::size_t>(level)] - fitted - expected;
    const double clearness = excess > 0 ? excess * excess / (expected + 0.3 * excess) : 0;
    if (clearness > largest) {
      largest = clearness;
      clearest = level;
    }
  }
  return clearest;
}

}  // namespace robust
}  // namespace hybridgv
