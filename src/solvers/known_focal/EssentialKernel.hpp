// The cubic equations behind EssentialForm, reduced: for three instruction sets.
#pragma once

#include "math/simd/SimdLevel.hpp"

namespace hybridgv {
namespace solvers {
namespace known_focal {

// Of the ten equations, those that express xxz, xxw, xyz, xyw, yyz, yyw by the monomials behind them, of which these are the coefficients.
struct ReducedCubics {
  static constexpr int kRows = 6, kColumns = 10;
  double row[kRows][kColumns];
  double leastPivot;  // 0 if one vanishes: then there are no rows
};

// Four 3x3 matrices row by row, and something behind each that is read and does not matter.
using EssentialBasis = double[4][10];

struct EssentialKernel {
  void (*reduce)(const EssentialBasis& basis, ReducedCubics& cubics);
};

// The version for the processor at hand.
const EssentialKernel& essentialKernel();
// The version for one level, which the processor must support.
const EssentialKernel& essentialKernel(math::SimdLevel level);

}  // namespace known_focal
}  // namespace solvers
}  // namespace hybridgv
