// Gaussian elimination of small complex systems, one system per SIMD lane.
#pragma once

#include "math/Complex.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

enum class Pivoting { None, Rows };

// Swaps rows k and `row` in the lanes of the mask.
template <int N, int Columns, class V>
HYBRIDGV_INLINE void swapRows(Complex<V> (&a)[N][Columns], int k, int row, Mask<V> mask) {
  for (int c = k; c < Columns; ++c) {
    const Complex<V> upper = a[k][c], lower = a[row][c];
    a[k][c] = select(mask, lower, upper);
    a[row][c] = select(mask, upper, lower);
  }
}

// [A | B] -> A^-1 B in the columns N.. of the same array (the columns before are overwritten by what is left of the elimination).
// Singular systems give infinite or undefined numbers, no trap.
template <Pivoting pivoting, int N, int Columns, class V>
HYBRIDGV_INLINE void solveInPlace(Complex<V> (&a)[N][Columns]) {
#pragma GCC unroll 8
  for (int k = 0; k < N; ++k) {
    if (pivoting == Pivoting::Rows) {
      // bring the largest element of column k up, by comparing with every row below
      for (int row = k + 1; row < N; ++row) swapRows(a, k, row, squaredNorm(a[row][k]) > squaredNorm(a[k][k]));
    }
    const Complex<V> inverse = reciprocal(a[k][k]);
#pragma GCC unroll 8
    for (int c = k + 1; c < Columns; ++c) a[k][c] = inverse * a[k][c];
#pragma GCC unroll 8
    for (int row = k + 1; row < N; ++row)
#pragma GCC unroll 8
      for (int c = k + 1; c < Columns; ++c) a[row][c] = subtractProduct(a[row][c], a[row][k], a[k][c]);
  }
#pragma GCC unroll 8
  for (int k = N - 1; k > 0; --k)
#pragma GCC unroll 8
    for (int row = 0; row < k; ++row)
#pragma GCC unroll 8
      for (int c = N; c < Columns; ++c) a[row][c] = subtractProduct(a[row][c], a[row][k], a[k][c]);
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv
