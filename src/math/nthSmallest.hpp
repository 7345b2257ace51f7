// Medians and quantiles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hybridgv {
namespace math {

// Puts the values of [begin, end) that are smaller than the pivot (or, with `OrEqual`, not larger) first, and returns the end of these.
// Every step does the same, whatever the value: a branch on one that is not known before costs more than three times as much.
template <bool OrEqual>
double* partitionByPivot(double* begin, double* end, double pivot) {
  double* middle = begin;
  for (double* at = begin; at != end; ++at) {
    const double value = *at;
    *at = *middle;
    *middle = value;
    middle += OrEqual ? !(pivot < value) : value < pivot;
  }
  return middle;
}

// The value that would be at place n (from 0) of the values in increasing order, which are reordered. `n` < size.
inline double nthSmallest(std::vector<double>& values, std::size_t n) {
  constexpr std::ptrdiff_t kFew = 16;
  constexpr int kRounds = 40;  // as a rule one for every halving; data that are made for it could take one for every value
  double *begin = values.data(), *end = begin + values.size(), *const wanted = begin + n;
  for (int round = 0; round < kRounds && end - begin > kFew; ++round) {
    const std::ptrdiff_t quarter = (end - begin) / 4;
    const double a = begin[quarter], b = begin[2 * quarter], c = begin[3 * quarter];
    const double pivot = std::max(std::min(a, b), std::min(std::max(a, b), c));
    double* const middle = partitionByPivot<false>(begin, end, pivot);
    if (wanted < middle) {
      end = middle;
    } else if (middle != begin) {
      begin = middle;
    } else {  // the pivot is the smallest
      begin = partitionByPivot<true>(begin, end, pivot);
      if (wanted < begin) return pivot;
    }
  }
  std::nth_element(begin, wanted, end);
  return *wanted;
}

// The middle value, the larger one of two; 0 of none.
inline double median(std::vector<double>& values) { return values.empty() ? 0 : nthSmallest(values, values.size() / 2); }

}  // namespace math
}  // namespace hybridgv
