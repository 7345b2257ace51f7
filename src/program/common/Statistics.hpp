// Order statistics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

// The value below which a share `q` (0 .. 1) of the values lies, interpolated linearly between neighbours; 0 for none. Infinite
// values count as such, so that failures may stand among the errors.
inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = q * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  return part > 0 ? (1 - part) * values[below] + part * values[below + 1] : values[below];
}

inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }
