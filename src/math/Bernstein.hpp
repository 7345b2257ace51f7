// Polynomials on [0, 1] in Bernstein form, sum_i b_i C(D,i) (1-x)^(D-i) x^i.
#pragma once

#include <cmath>

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
    last = coefficient, free = 0;
  }
  changes.most += last == 0 ? (free > 0 ? free - 1 : 0) : free;
  return changes;
}

// de Casteljau at 1/2: the coefficients on [0, 1/2] and [1/2, 1].
template <int D>
void halve(const double (&b)[D + 1], double (&left)[D + 1], double (&right)[D + 1]) {
  for (int i = 0; i <= D; ++i) right[i] = b[i];
  for (int level = 0; level <= D; ++level) {
    left[level] = right[0];
    for (int i = 0; i < D - level; ++i) right[i] = (right[i] + right[i + 1]) / 2;
  }
}

}  // namespace math
}  // namespace hybridgv
