// H51f except for five rays of one centre, with all choices open.
#pragma once

#include "solvers/MinimalSolver.hpp"
#include "solvers/h51f/solvePaths.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

// Writes the poses to `solutions` and returns their number; contract of MinimalProblems.hpp. `ends` tells whether the set of
// complex solutions behind them is complete; it has no paths if the sample cannot be normalized.
int solve(math::SimdLevel level, const RayMatch* rays, const PointMatch& point, FocalPose* solutions, EndPoints* ends);

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
