// Medians of squared errors, and what they are for normal errors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "math/nthSmallest.hpp"

namespace hybridgv {
namespace robust {

// Median of the square of one and of the sum of the squares of two standard normal variables.
constexpr double kMedianOfOneSquare = 0.4549364231195728, kMedianOfTwoSquares = 1.3862943611198906;

using math::median;

// How many are below a threshold.
inline std::size_t countBelow(const std::vector<double>& squaredErrors, double threshold) {
  const auto isBelow = [&](double e) { return e < threshold * threshold; };
  return static_cast<std::size_t>(std::count_if(squaredErrors.begin(), squaredErrors.end(), isBelow));
}

// The squared errors of those below a threshold.
inline std::vector<double> below(const std::vector<double>& squaredErrors, double threshold) {
  const double squaredThreshold = threshold * threshold;
  std::vector<double> result(squaredErrors.size());
  std::size_t size = 0;
  for (const double e : squaredErrors) {
    result[size] = e;
    size += e < squaredThreshold;
  }
  result.resize(size);
  return result;
}

}  // namespace robust
}  // namespace hybridgv
