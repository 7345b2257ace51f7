// H70f for rays of which at most five have one centre, with all choices open.
#pragma once

#include "solvers/MinimalSolver.hpp"
#include "solvers/h70f/Reduction.hpp"
#include "solvers/h70f/solvePaths.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

// Writes the poses to `solutions` and returns their number; contract of MinimalProblems.hpp. `ends` tells whether the set of
// complex solutions behind them is complete; it has no paths if the sample cannot be normalized.
int solve(math::SimdLevel level, const RayMatch* rays, const Groups& groups, FocalPose* solutions, EndPoints* ends);

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
