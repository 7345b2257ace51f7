// Runs a minimal solver on correspondences of an adapter; the body of every public solver function.
#pragma once

#include <vector>

#include "hybridgv/hybrid_pose/HybridAdapterBase.hpp"
#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace solvers {

// Reads rays indices[0] and points indices[1] (as many as the problem needs), checks them and solves.
FocalPoses solveSample(SolveFunction solve, int rays, int points, int maxSolutions, const hybrid_pose::HybridAdapterBase& adapter,
                       const std::vector<std::vector<int>>& indices);

// {0, 1, .., rays-1}, {0, 1, .., points-1}
std::vector<std::vector<int>> firstIndices(int rays, int points);

}  // namespace solvers
}  // namespace hybridgv
