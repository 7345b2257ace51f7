#define HYBRIDGV_INSTRUCTION_SET sse2
#include "solvers/h51f/PathProblem.hpp"
#include "solvers/h51f/solvePaths.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

void solvePathsSse2(const StartSystem& start, const Parameters& target, EndPoints* ends) {
  hybridgv::sse2::PathSolver<hybridgv::sse2::H51fPathProblem>({start, target}).solve(ends);
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
