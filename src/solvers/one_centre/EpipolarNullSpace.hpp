// The fundamental matrices that are consistent with six correspondences.
#pragma once

#include "math/simd/Lanes.hpp"
#include "solvers/one_centre/OneFocalFundamental.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

// The nine entries of a 3x3 matrix, row by row, and a zero.
struct PaddedMatrix {
  static constexpr int kPairs = 5;
  math::Pair e[kPairs];

  double operator[](int i) const { return e[i / 2][i % 2]; }
};

// Orthonormal basis of the matrices F with p_k^T F q_k = 0, k = 1..6; false unless the six constraints are independent.
bool epipolarNullSpace(const SixCorrespondences& correspondences, PaddedMatrix* basis);

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv
