// H51f: five rays and one point; the algorithm depends on which rays share a centre.
#include <algorithm>

#include "solvers/h51f/Reduction.hpp"
#include "solvers/h51f/solve.hpp"
#include "solvers/solvers.hpp"

namespace hybridgv {
namespace solvers {

int h51f(const RayMatch* rays, const PointMatch* points, FocalPose* solutions) {
  const auto belongsToFirst = [&](const RayMatch& ray) { return hybridgv::h51f::sameCentre(rays[0], ray, points[0].point); };
  if (std::all_of(rays + 1, rays + hybridgv::h51f::kRays, belongsToFirst)) return h51fOneCentre(rays, points, solutions);
  hybridgv::h51f::EndPoints ends;
  return hybridgv::h51f::solve(math::simdLevel(), rays, points[0], solutions, &ends);
}

}  // namespace solvers
}  // namespace hybridgv
