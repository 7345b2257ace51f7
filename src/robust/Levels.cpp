#include "robust/Levels.hpp"

#include <algorithm>
#include <cmath>

namespace hybridgv {
namespace robust {

LevelCounts countLevels(const double* squaredErrors, std::size_t size, double squaredThreshold) {
  LevelCounts counts;
  kernels().countLevels(squaredErrors, size, squaredThreshold, counts.data());
  return counts;
}

double thresholdAt(double threshold, int level) { return std::ldexp(threshold, -level); }

std::size_t levelOf(double scale) { return static_cast<std::size_t>(std::clamp(-std::ilogb(scale), 0, kLevels - 1)); }

Shares largest(const Shares& a, const Shares& b) {
  Shares result;
  for (std::size_t level = 0; level < kLevels; ++level) {
    result.rays[level] = std::max(a.rays[level], b.rays[level]);
    result.points[level] = std::max(a.points[level], b.points[level]);
  }
  return result;
}

Shares meanOf(const std::vector<Shares>& shares) {
  Shares sum{};
  for (const Shares& of : shares)
    for (std::size_t level = 0; level < kLevels; ++level) {
      sum.rays[level] += of.rays[level] / static_cast<double>(shares.size());
      sum.points[level] += of.points[level] / static_cast<double>(shares.size());
    }
  return sum;
}

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
