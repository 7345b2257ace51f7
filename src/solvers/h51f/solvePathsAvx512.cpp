#define HYBRIDGV_INSTRUCTION_SET avx512
#include "solvers/h51f/PathSolver.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

void solvePathsAvx512(const StartSystem& start, const Parameters& target, EndPoints* ends) {
  hybridgv::avx512::PathSolver(start, target).solve(ends);
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
