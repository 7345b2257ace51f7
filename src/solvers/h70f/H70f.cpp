// H70f: seven rays; the algorithm depends on which of them share a centre.
#include "solvers/MinimalProblems.hpp"
#include "solvers/h70f/solve.hpp"

namespace hybridgv {
namespace solvers {
namespace h70f {

int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  const Groups groups(rays);
  if (groups.size(0) == kRays) return 0;  // no scale
  if (groups.size(0) < kRays - 1) {
    EndPoints ends;
    return solve(math::simdLevel(), rays, groups, solutions, &ends);
  }
  RayMatch oneLast[kRays];
  int next = 0;
  for (int j = 0; j < kRays; ++j) oneLast[groups.of(j) == 0 ? next++ : kRays - 1] = rays[j];
  return one_centre::h70f(oneLast, points, solutions);
}

}  // namespace h70f
}  // namespace solvers
}  // namespace hybridgv
