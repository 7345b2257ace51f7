#include "solvers/h70f/solvePaths.hpp"

#include "math/simd/versions.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

HYBRIDGV_VERSIONS(SolvePaths, kSolvePaths)

void solvePaths(math::SimdLevel level, const StartSystem& start, const Parameters& target, EndPoints* ends) {
  const SolvePaths solve = math::choose(level, baseline::kSolvePaths, avx2::kSolvePaths, avx512::kSolvePaths);
  solve(start, target, ends);
}

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
