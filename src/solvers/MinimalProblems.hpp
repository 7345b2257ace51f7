// What a minimal solver is, and the list of them all.
//
// A new solver is one file in this folder, one row in MinimalProblems.cpp, and one public function in a methods.hpp.
#pragma once

#include "correspondences/Correspondence.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace solvers {

using correspondences::PointMatch;
using correspondences::RayMatch;

// Upper bound of the number of solutions of any minimal problem here.
constexpr int kMaxSolutions = 56;

// Finds the poses that are consistent with the sample, writes them to `solutions` and returns their number. All solvers keep
// this contract:
//  * the input is finite; its image coordinates and lengths may have any unit and scale, at least from 1e-150 to 1e150
//    (the solver normalizes inside);
//  * every returned pose satisfies the equations, has f > 0, det rotation = +1, positive depths of points and rays;
//  * no solution is returned twice; degenerate input gives 0 solutions; nothing is NaN;
//  * no allocation, no global state, bounded time.
using SolveFunction = int (*)(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);

struct MinimalSolver {
  Solver id;
  const char* name;
  int rays;    // 2D-2D correspondences in a sample
  int points;  // 2D-3D correspondences in a sample
  int maxSolutions;
  double cost;  // microseconds per call, between those of the instruction sets: for choosing between solvers
  SolveFunction solve;
};

const MinimalSolver& minimalSolver(Solver id);

}  // namespace solvers
}  // namespace hybridgv
