#define HYBRIDGV_INSTRUCTION_SET avx2
#include "solvers/h51f/PathSolver.hpp"

namespace hybridgv {
namespace h51f {

void solvePathsAvx2(const StartSystem& start, const Parameters& target, EndPoints* ends) {
  avx2::PathSolver(start, target).solve(ends);
}

}  // namespace h51f
}  // namespace hybridgv
