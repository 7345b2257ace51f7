#define HYBRIDGV_INSTRUCTION_SET avx512
#include "solvers/h51f/PathProblem.hpp"
#include "solvers/h51f/solvePaths.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

void solvePathsAvx512(const StartSystem& start, const Parameters& target, EndPoints* ends) {
  hybridgv::avx512::PathSolver<hybridgv::avx512::H51fPathProblem>({start, target}).solve(ends);
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
