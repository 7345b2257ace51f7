// Polynomials on [0, 1] in Bernstein form, sum_i b_i C(D,i) (1-x)^(D-i) x^i.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>

namespace hybridgv {
namespace math {

// The smallest and largest number of sign changes that the coefficients can have.
struct SignChanges {
  int least, most;
};

// Coefficients b_0 .. b_D with |b_i| <= tolerance may have either sign. By Descartes' rule `most` = 0 excludes a root in (0, 1),
// and `least` = `most` = 1 guarantees exactly one.
template <int D>
SignChanges signChanges(const double (&b)[D + 1], double tolerance) {
  SignChanges changes{0, 0};
  double last = 0;  // the last coefficient of certain sign
  int free = 0;     // those of uncertain sign after it
  for (double coefficient : b) {
    if (!(std::abs(coefficient) > tolerance)) {
      ++free;
      continue;
    }
    if (last == 0) {
      changes.most += free;
    } else {
      // Between two certain signs the number of changes is odd if they differ, else even, and at most free + 1.
      const bool differ = (coefficient > 0) != (last > 0);
      changes.least += differ;
      changes.most += free + ((free % 2 == 0) == differ);
    }
    last = coefficient;
    free = 0;
  }
  changes.most += last == 0 ? (free > 0 ? free - 1 : 0) : free;
  return changes;
}

// One level of de Casteljau's scheme at 1/2, and those after it: on level k, b_i is replaced by (b_i + b_(i+1)) / 2 for i <= D-k.
// The first of every level belong to the left half, the last to the right one. Written out without loops, so that all stays in
// registers; the factors 2^-k come last.
template <int D, std::size_t... I>
void halveLevels(double (&sums)[D + 1], double (&left)[D + 1], std::index_sequence<I...>) {
  constexpr int kLevel = D - static_cast<int>(sizeof...(I));
  constexpr double kFactor = 1.0 / (1 << kLevel);
  left[kLevel] = kFactor * sums[0];
  if constexpr (kLevel < D) {
    ((sums[I] += sums[I + 1]), ...);
    halveLevels<D>(sums, left, std::make_index_sequence<D - kLevel - 1>());
  }
}

// The coefficients on [0, 1/2] and [1/2, 1].
template <int D>
void halve(const double (&b)[D + 1], double (&left)[D + 1], double (&right)[D + 1]) {
  double sums[D + 1];
  for (int i = 0; i <= D; ++i) sums[i] = b[i];
  halveLevels<D>(sums, left, std::make_index_sequence<D>());
  double factor = 1;
  for (int i = D; i >= 0; --i, factor /= 2) right[i] = factor * sums[i];
}

}  // namespace math
}  // namespace hybridgv
