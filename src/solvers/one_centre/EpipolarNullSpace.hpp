// The fundamental matrices that are consistent with six correspondences.
#pragma once

#include "solvers/NullSpace.hpp"
#include "solvers/one_centre/OneFocalFundamental.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

// Orthonormal basis of the matrices F with p_k^T F q_k = 0, k = 1..6; false unless the six constraints are independent.
bool epipolarNullSpace(const SixCorrespondences& correspondences, PaddedMatrix* basis);

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv
