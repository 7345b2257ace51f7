// What a minimal solver is, and what it promises.
#pragma once

#include <optional>

#include "correspondences/Correspondence.hpp"
#include "correspondences/Intrinsics.hpp"
#include "hybridgv/types.hpp"

namespace hybridgv {
namespace solvers {

using correspondences::PointMatch;
using correspondences::RayMatch;

// Finds the poses that are consistent with the sample, writes them to `solutions` and returns their number. All solvers keep
// this contract:
//  * the input is finite; its image coordinates and lengths may have any unit and scale, at least from 1e-150 to 1e150
//    (the solver normalizes inside);
//  * a solver that does not estimate the focal length takes image coordinates in units of it: (u, v, 1) is the direction in which
//    the query sees an image point, and the poses have the focal length 1;
//  * every returned pose satisfies the equations, has f > 0, det rotation = +1, positive depths of points and rays;
//  * no solution is returned twice; degenerate input gives 0 solutions; nothing is NaN;
//  * no allocation, no global state, bounded time.
using SolveFunction = int (*)(const RayMatch* rays, const PointMatch* points, FocalPose* solutions);

// The same for several samples of points side by side, at most kSideBySide, which takes less time than one after the other: those of
// sample i begin at points[i * solver.points], its solutions at solutions[i * solver.maxSolutions], and found[i] is their number. They
// do not depend on the other samples.
using SolveManyFunction = void (*)(const PointMatch* points, int samples, FocalPose* solutions, int* found);
constexpr int kSideBySide = 8;

// How the rays of a sample are chosen among the rig cameras.
enum class RayDraw {
  Uniform,    // every set of rays is equally likely
  OneCamera,  // all from one camera, drawn with probability proportional to its number of rays
  AllButOne,  // all but one from one camera, drawn in proportion to its number of rays, and one from any of the others
  Spread,     // from as many cameras as possible, each camera as likely as the other
};

// A way to draw a sample of a minimal problem and to solve it.
struct MinimalSolver {
  // None where the position is found up to scale only: it is returned at distance 1 from the rays' common centre, and neither
  // hybridRansac nor the problems for OpenGV's loops can draw it.
  std::optional<Solver> id;
  const char* name;  // of the public function
  int rays;          // 2D-2D correspondences in a sample
  int points;        // 2D-3D correspondences in a sample
  RayDraw draw;
  int maxSolutions;
  double cost;   // microseconds per call, between those of the instruction sets: for choosing between solvers
  double prior;  // weight among hybridRansac's solvers by default, 0: not one of them
  // How many image coordinates of the points, counted from the first, all solutions satisfy; the others only rank or reject.
  int exactCoordinates;
  bool followsPaths;                       // a homotopy: a path, and with it a solution, may be lost, about one in ten thousand
  correspondences::Intrinsics intrinsics;  // what it estimates of the query's camera
  SolveFunction solve;
  SolveManyFunction solveMany = nullptr;  // null: one at a time
};

}  // namespace solvers
}  // namespace hybridgv
