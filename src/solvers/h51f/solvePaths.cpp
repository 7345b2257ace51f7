#include "solvers/h51f/solvePaths.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

void solvePaths(math::SimdLevel level, const StartSystem& start, const Parameters& target, EndPoints* ends) {
#ifdef HYBRIDGV_X86_KERNELS
  if (level == math::SimdLevel::Avx512) return solvePathsAvx512(start, target, ends);
  if (level == math::SimdLevel::Avx2) return solvePathsAvx2(start, target, ends);
#else
  static_cast<void>(level);
#endif
  solvePathsSse2(start, target, ends);
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
