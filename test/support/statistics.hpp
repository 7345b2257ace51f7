// Middle of a list of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hybridgv {
namespace test {

// The upper one of the two middle ones of an even number; needs at least one.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace test
}  // namespace hybridgv
