// H51f by a method that has nothing in common with the library's but the problem: all unknowns but the query's viewing direction
// are eliminated in closed form, and the real zeros of two functions on the sphere of directions are isolated. It finds real
// solutions only and cannot tell whether one is missing. Not for five rays of one centre.
//
// The functions (Equations.hpp) are sampled at the vertices of an icosphere. A triangle survives if linear interpolation says
// that both functions vanish in it or, within a margin, near it; survivors are divided in four and tested again. From each
// triangle left, Newton's method is run on the equations
//
//   g_j = -n.m - kappa (px r1.m + py r2.m) + rho (Dx r2.q - Dy r1.q) + rho kappa s n.q = 0,   s = px p0y - py p0x,
//
// for the rotation, kappa = 1/f and rho = d/f.
#pragma once

#include <vector>

#include "solvers/MinimalSolver.hpp"

namespace hybridgv {
namespace test {
namespace h51f_sphere {

struct Resolution {
  int frequency;  // of the icosphere
  double margin;  // of its triangles, in units of their size
  int levels;     // of subdivision, at most 2
  double levelMargin[2];
  double parallelMargin;  // additional, where the two zero lines in a triangle are nearly parallel
};
constexpr Resolution kCoarse{16, 0.7, 1, {0.5, 0}, 0.3}, kMedium{24, 1, 1, {0.6, 0}, 0.3}, kFine{32, 1, 2, {1, 0.7}, 1};

// Poses that satisfy the equations with d > 0; the rays may be met behind a camera.
FocalPoses solve(const std::vector<solvers::RayMatch>& rays, const solvers::PointMatch& point, const Resolution& resolution);

}  // namespace h51f_sphere
}  // namespace test
}  // namespace hybridgv
