// What a minimal solver is, and the list of them all.
//
// A new solver is one file in this folder, one row in MinimalSolver.cpp, and one public function in a methods.hpp.
#pragma once

#include <Eigen/Core>

#include "hybridgv/types.hpp"

namespace hybridgv {
namespace solvers {

// A 2D-2D correspondence: the query's image point (u, v) and the viewing ray centre + beta direction in the rig's frame.
// Rays with equal `camera` have the same centre.
struct RayMatch {
  double u, v;
  Eigen::Vector3d centre;
  Eigen::Vector3d direction;  // unit length
  int camera;
};

// A 2D-3D correspondence: the query's image point (u, v) and a point in the rig's frame.
struct PointMatch {
  double u, v;
  Eigen::Vector3d point;
};

// Upper bound of the number of solutions of any minimal problem here.
constexpr int kMaxSolutions = 56;

// Finds the poses that are consistent with the sample, writes them to `solutions` and returns their number. All solvers keep
// this contract:
//  * the input is finite; its image coordinates and lengths may have any unit and scale, at least from 1e-150 to 1e150 (the
//  solver
//    normalises inside);
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
