#define HYBRIDGV_INSTRUCTION_SET avx2
#include "solvers/h51f/PathProblem.hpp"
#include "solvers/h51f/solvePaths.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

void solvePathsAvx2(const StartSystem& start, const Parameters& target, EndPoints* ends) {
  hybridgv::avx2::PathSolver<hybridgv::avx2::H51fPathProblem>({start, target}).solve(ends);
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
