// solvePaths for the instruction set of the including file.
#pragma once

#include "solvers/h70f/PathProblem.hpp"
#include "solvers/h70f/solvePaths.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {
namespace HYBRIDGV_INSTRUCTION_SET {

static void solvePaths(const StartSystem& start, const Parameters& target, EndPoints* ends) {
  PathSolver<H70fPathProblem>({start, target}).solve(ends);
}

extern const SolvePaths kSolvePaths;
const SolvePaths kSolvePaths = &solvePaths;

}  // namespace HYBRIDGV_INSTRUCTION_SET
}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
