// Medians of squared errors, and what they are for normal errors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace hybridgv {
namespace robust {

// Median of the square of one and of the sum of the squares of two standard normal variables.
constexpr double kMedianOfOneSquare = 0.4549364231195728, kMedianOfTwoSquares = 1.3862943611198906;

// 0 of none. Reorders the values.
inline double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The squared errors of those below a threshold.
inline std::vector<double> below(const std::vector<double>& squaredErrors, double threshold) {
  std::vector<double> result;
  result.reserve(squaredErrors.size());
  std::copy_if(squaredErrors.begin(), squaredErrors.end(), std::back_inserter(result),
               [&](double e) { return e < threshold * threshold; });
  return result;
}

}  // namespace robust
}  // namespace hybridgv
