// Gaussian elimination of small real matrices, one matrix per SIMD lane, each with its own pivots.
#pragma once

#include "math/simd/Lanes.hpp"

namespace hybridgv {
namespace math {
inline namespace HYBRIDGV_INSTRUCTION_SET {

// Swaps a and b in the lanes of the mask.
HYBRIDGV_INLINE void swapWhere(DoubleMask mask, Doubles& a, Doubles& b) {
  const DoubleMask difference = ((DoubleMask)a ^ (DoubleMask)b) & mask;
  a = (Doubles)((DoubleMask)a ^ difference);
  b = (Doubles)((DoubleMask)b ^ difference);
}

// 1 / a, and 1 / limit where |a| < limit.
HYBRIDGV_INLINE Doubles boundedReciprocal(Doubles a, double limit) {
  return 1 / select<Doubles>(absolute(a) < limit, broadcast<Doubles>(limit), a);
}

// Brings m to upper triangular form by row operations and returns its determinant. Partial pivoting: comparing with every row
// below lets the largest element of column k rise to the diagonal. What is below the diagonal is left undefined.
template <int Size>
HYBRIDGV_INLINE Doubles eliminate(Doubles (&m)[Size][Size]) {
  Doubles determinant = broadcast<Doubles>(1);
  for (int k = 0; k < Size; ++k) {
    for (int row = k + 1; row < Size; ++row) {
      const DoubleMask larger = absolute(m[row][k]) > absolute(m[k][k]);
      for (int c = k; c < Size; ++c) swapWhere(larger, m[k][c], m[row][c]);
      determinant = (Doubles)((DoubleMask)determinant ^ (larger & signBit<Doubles>()));
    }
    determinant *= m[k][k];
    const Doubles inverse = boundedReciprocal(m[k][k], 1e-300);
    for (int row = k + 1; row < Size; ++row) {
      const Doubles factor = m[row][k] * inverse;
      for (int c = k + 1; c < Size; ++c) m[row][c] -= factor * m[k][c];
    }
  }
  return determinant;
}

// The null vector of an eliminated m whose last pivot is zero up to rounding; its last element is 1.
template <int Size>
HYBRIDGV_INLINE void nullVector(const Doubles (&m)[Size][Size], Doubles (&v)[Size]) {
  v[Size - 1] = broadcast<Doubles>(1);
  for (int k = Size - 2; k >= 0; --k) {
    Doubles sum = m[k][k + 1] * v[k + 1];
    for (int c = k + 2; c < Size; ++c) sum += m[k][c] * v[c];
    v[k] = -sum * boundedReciprocal(m[k][k], 1e-300);
  }
}

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace math
}  // namespace hybridgv
