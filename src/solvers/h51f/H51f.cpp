// H51f: five rays and one point; the algorithm depends on which rays share a centre.
#include <algorithm>

#include "solvers/MinimalProblems.hpp"
#include "solvers/h51f/Reduction.hpp"
#include "solvers/h51f/solve.hpp"

namespace hybridgv {
namespace solvers {
namespace h51f {

int solve(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  const auto belongsToFirst = [&](const RayMatch& ray) { return sameCentre(rays[0], ray, points[0].point); };
  if (std::all_of(rays + 1, rays + kRays, belongsToFirst)) return one_centre::h51f(rays, points, solutions);
  EndPoints ends;
  return solve(math::simdLevel(), rays, points[0], solutions, &ends);
}

}  // namespace h51f
}  // namespace solvers
}  // namespace hybridgv
