#include "solvers/one_centre/EpipolarNullSpace.hpp"

#include <cmath>

namespace hybridgv {
namespace solvers {
namespace one_centre {

// The rows p_k (x) q_k, p_k = (u, v, 1), normalized.
bool epipolarNullSpace(const SixCorrespondences& correspondences, PaddedMatrix* basis) {
  using math::Pair;
  PaddedMatrix rows[kSix];
  for (int k = 0; k < kSix; ++k) {
    const double u = correspondences.u[k], v = correspondences.v[k];
    const double scale = 1 / std::sqrt(u * u + v * v + 1);
    const double x = scale * correspondences.x[k], y = scale * correspondences.y[k], z = scale * correspondences.z[k];
    rows[k] = {Pair{u * x, u * y}, Pair{u * z, v * x}, Pair{v * y, v * z}, Pair{x, y}, Pair{z, 0}};
  }
  return nullSpace(rows, basis);
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv
